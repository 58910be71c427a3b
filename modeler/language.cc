#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "modeler/align.hh"
#include "modeler/arguments.hh"
#include "modeler/hull.hh"
#include "modeler/language_extrude.hh"
#include "modeler/language_outline.hh"
#include "modeler/language_resize.hh"
#include "modeler/language_solids.hh"
#include "modeler/language_transforms.hh"
#include "modeler/makes_nothing.hh"
#include "modeler/model.hh"
#include "modeler/name_table.hh"
#include "modeler/pending_halfspace.hh"
#include "modeler/solid_extent.hh"
#include "modeler/tree_building.hh"
#include "modeler/trim.hh"

namespace maille::modeler {
namespace {

constexpr NameRow<std::optional<Operation>> operations[] = {
    {"union", Operation::join},
    {"group", Operation::join},
    {"color", Operation::join},
    {"render", Operation::join},
    {"fragment", Operation::fragment},
    {"difference", Operation::difference},
    {"intersection", Operation::intersection},
};

constexpr std::string_view attributes[] = {"name", "size", "material"};

/// Nodes that are in no table.
constexpr std::string_view more_nodes[] = {"halfspace", "hull", "resize"};

/// Nodes of OpenSCAD's dumps that make or use what this language has not.
constexpr std::string_view unsupported[] = {
    "text", "surface", "minkowski", "projection", "roof", "intersection_for",
};

/// Words of OpenSCAD's full language, which its dumps no longer hold.
constexpr std::string_view full_language[] = {"module", "function", "for",      "if",  "else",    "let",
                                              "assert", "echo",     "children", "use", "include", "each"};

bool is_one_of(std::string_view name, std::span<const std::string_view> names) {
    return std::ranges::find(names, name) != names.end();
}

/// What a node inherits from those around it.
struct Context {
    Placement placement;
    std::string name;
    std::string material;
    double size = 0;
};

/// The factors of the `resize` nodes met so far.
using Resizes = std::map<const Node*, Point>;

/// The node marked as the whole model, if there is one; the first, if there are more.
const Node* find_root(const std::vector<Node>& nodes) {
    for (const Node& node : nodes) {
        if (node.disabled) continue;
        if (node.is_root) return &node;
        if (const Node* root = find_root(node.children)) return root;
    }
    return nullptr;
}

/// Turns the nodes of one file into a model.
class ModelMaker {
  public:
    /// `resizes` remembers the factors of `resize` nodes: those in others are asked for again and again.
    ModelMaker(const std::string& file, Resizes& resizes) : file_(file), resizes_(resizes) {}

    Model make(std::span<const Node> nodes, Facets facets) {
        const Context context{.placement = {.facets = facets}, .name = {}, .material = {}};
        model_.tree = combine(Operation::join, trees_of(nodes, context));
        shape_halfspaces();
        drop_unused_primitives(model_);
        return std::move(model_);
    }

  private:
    std::vector<CsgTree> trees_of(std::span<const Node> nodes, const Context& context) {
        return made_of(nodes, [&](const Node& node) { return tree_of(node, context); });
    }

    CsgTree tree_of(const Node& node, const Context& context) {
        if (const SolidMaker make_shape = find_solid(node.name)) {
            refuse_children(node);
            return add_primitive(node, context, make_shape(node, file_, context.placement));
        }
        if (node.name == "halfspace") return add_halfspace(node, context);
        if (const Extruder extrude = find_extruder(node.name))
            return add_primitives(node, context, extrude(node, file_, context.placement));
        if (const TransformReader read = find_transform(node.name))
            return combine(Operation::join,
                           trees_of(node.children, transformed(node, read(node, file_), context)));
        if (node.name == "resize")
            return combine(Operation::join,
                           trees_of(node.children, transformed(node, resize(node, context), context)));
        if (node.name == "hull") return add_hull(node, context);
        if (is_one_of(node.name, attributes))
            return combine(Operation::join, trees_of(node.children, with_attribute(node, context)));
        if (const auto operation = look_up(operations, node.name)) {
            if (node.name == "color")
                const Arguments checked(node, file_, {"c", "alpha"});
            else
                const Arguments checked(node, file_, {});
            return combine(*operation, trees_of(node.children, context));
        }
        throw unknown(node);
    }

    void refuse_children(const Node& node) const {
        if (!node.children.empty())
            throw located_error(file_, node.children.front().at,
                                fmt::format("'{}' takes no children: is a ';' missing?", node.name));
    }

    InputError unknown(const Node& node) const {
        if (is_flat_node(node.name))
            return located_error(
                file_, node.at,
                fmt::format("'{}' is flat: it stands in a linear_extrude or rotate_extrude only", node.name));
        if (is_one_of(node.name, unsupported))
            return located_error(file_, node.at, fmt::format("'{}' is not supported", node.name));
        if (is_one_of(node.name, full_language))
            return located_error(file_, node.at,
                                 fmt::format("'{}' is not supported: have OpenSCAD write the .csg file "
                                             "(openscad -o part.csg part.scad)",
                                             node.name));
        std::vector<std::string_view> known = solid_names();
        std::ranges::copy(more_nodes, std::back_inserter(known));
        std::ranges::copy(extruder_names(), std::back_inserter(known));
        std::ranges::copy(transform_names(), std::back_inserter(known));
        std::ranges::copy(attributes, std::back_inserter(known));
        std::ranges::copy(names_of(operations), std::back_inserter(known));
        return located_error(file_, node.at,
                             fmt::format("unknown node '{}'{}", node.name, suggestion(node.name, known)));
    }

    /// The nodes in a node as a model of their own, not moved by what is around it.
    Model alone(const Node& node, Facets facets) const {
        return ModelMaker(file_, resizes_).make(node.children, facets);
    }

    Eigen::Affine3d resize(const Node& node, const Context& context) const {
        auto known = resizes_.find(&node);
        if (known == resizes_.end()) {
            const Model inner = alone(node, context.placement.facets);
            known = resizes_.emplace(&node, resize_factors(node, file_, solid_box(inner))).first;
        }
        return Eigen::Affine3d(Eigen::Scaling(known->second));
    }

    CsgTree add_hull(const Node& node, const Context& context) {
        const Arguments arguments(node, file_, {});
        const Model inner = alone(node, Facets::keep);
        if (is_empty(inner.tree)) return {};
        return add_primitive(node, context, at_node(arguments, [&] {
                                 return make_hull(boundary_points(inner), context.placement.frame);
                             }));
    }

    Context transformed(const Node& node, const Eigen::Affine3d& map, const Context& context) const {
        Context result = context;
        result.placement.frame = context.placement.frame * map;
        if (!is_regular(result.placement.frame))
            throw MakesNothing(located_error(
                file_, node.at, fmt::format("'{}' flattens its children or has no inverse", node.name)));
        return result;
    }

    Context with_attribute(const Node& node, const Context& context) const {
        if (node.children.empty())
            throw located_error(
                file_, node.at,
                fmt::format("'{}' stands before no node: is there a ';' too many?", node.name));
        Context result = context;
        const Arguments arguments(node, file_, {"value"});
        if (node.name == "size")
            result.size = arguments.positive("value");
        else
            (node.name == "name" ? result.name : result.material) = checked_name(arguments);
        return result;
    }

    /// Names become names of sets, in which a slash parts the primitive from its face.
    static std::string checked_name(const Arguments& arguments) {
        const std::string& name = arguments.text("value");
        const auto bad = [](char c) { return c == '/' || c == '"' || static_cast<unsigned char>(c) < ' '; };
        if (name.empty()) throw arguments.error("value", "the name must not be empty");
        if (std::ranges::any_of(name, bad))
            throw arguments.error("value", "a name must have no slash, no quotes and no line break");
        return name;
    }

    CsgTree add_primitive(const Node& node, const Context& context, std::shared_ptr<const Shape> shape) {
        const auto index = static_cast<std::uint32_t>(model_.primitives.size());
        model_.primitives.push_back(
            {.shape = std::move(shape),
             .name = context.name.empty() ? fmt::format("{}{}", node.name, index + 1) : context.name,
             .material = context.material,
             .size = context.size});
        return {.operation = Operation::leaf, .primitive = index};
    }

    /// The leaves of the shapes' tree are primitives of one name.
    CsgTree add_primitives(const Node& node, Context context, const ShapeTree& shapes) {
        if (context.name.empty()) context.name = fmt::format("{}{}", node.name, model_.primitives.size() + 1);
        if (shapes.operation == Operation::leaf) return add_primitive(node, context, shapes.shape);
        std::vector<CsgTree> children;
        for (const ShapeTree& child : shapes.children)
            children.push_back(add_primitives(node, context, child));
        return combine(shapes.operation, std::move(children));
    }

    CsgTree add_halfspace(const Node& node, const Context& context) {
        refuse_children(node);
        const Arguments arguments(node, file_, {"point", "normal"});
        const Point normal = arguments.vector("normal");
        if (normal.isZero(0)) throw arguments.error("normal", "the normal must not be 0");
        const Eigen::Affine3d& frame = context.placement.frame;
        CsgTree leaf = add_primitive(node, context, nullptr);
        halfspace_at_[leaf.primitive] = node.at;
        halfspaces_.push_back({.primitive = leaf.primitive,
                               .point = frame * arguments.vector("point"),
                               .normal = (frame.linear().inverse().transpose() * normal).stableNormalized()});
        return leaf;
    }

    void shape_halfspaces() {
        if (const auto culprit = modeler::shape_halfspaces(model_, halfspaces_))
            throw located_error(
                file_, halfspace_at_.at(*culprit),
                "this half-space makes the model endless: intersect it with a solid, or subtract it "
                "from one");
    }

    const std::string& file_;
    Resizes& resizes_;
    Model model_;
    std::vector<PendingHalfspace> halfspaces_;
    std::map<std::uint32_t, Location> halfspace_at_;
};

}  // namespace

Model parse_model(std::string_view text, const std::string& name, Facets facets) {
    const std::vector<Node> nodes = parse(text, name);
    const Node* root = find_root(nodes);
    Resizes resizes;
    Model model =
        ModelMaker(name, resizes).make(root != nullptr ? std::span(root, 1) : std::span(nodes), facets);
    if (is_empty(model.tree)) throw InputError(fmt::format("{}: the model is empty: it has no solid", name));
    const Eigen::AlignedBox3d box = bounding_box(model);
    return box.isEmpty() ? model : aligned(trimmed(model), written_precision * box.diagonal().norm());
}

Model read_model(const std::filesystem::path& path, Facets facets) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    if (std::filesystem::is_directory(path) || !file)
        throw InputError(fmt::format("{}: cannot read this file", path.string()));
    text << file.rdbuf();
    if (path.extension() == ".geo") return parse_geo_model(text.view(), path.string());
    return parse_model(text.view(), path.string(), facets);
}

}  // namespace maille::modeler
