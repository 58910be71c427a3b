// From Netgen's solids, which may have no end, to a model of primitives that have one.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "modeler/geo_bounds.hh"
#include "modeler/geo_parser.hh"
#include "modeler/model.hh"
#include "modeler/shapes.hh"
#include "modeler/tree_building.hh"
#include "volmesh/error.hh"

namespace maille::modeler {
namespace {

using Eigen::AlignedBox3d;
using Kind = GeoNode::Kind;

AlignedBox3d grown(const AlignedBox3d& box, double part) {
    const Point margin = Point::Constant(part * box.diagonal().norm());
    return {box.min() - margin, box.max() + margin};
}

/// A box around a solid, from the planes that its primitives are behind.
class Bounds {
  public:
    explicit Bounds(const AlignedBox3d& world) : world_(world) {}

    AlignedBox3d of(const GeoNode& node) const { return of(node, {}); }

  private:
    AlignedBox3d of(const GeoNode& node, std::vector<Plane> planes) const {
        if (node.kind == Kind::any) {
            AlignedBox3d box;
            for (const GeoSolid& child : node.children) box.extend(of(*child, planes));
            return box;
        }
        std::vector<const GeoNode*> unions;
        collect(node, planes, unions);
        AlignedBox3d box = box_behind(planes, world_);
        // What is endless here may end within each part of a union.
        for (const GeoNode* child : unions)
            if (reaches(box, world_)) box = box.intersection(of(*child, planes));
        return box;
    }

    static void collect(const GeoNode& node, std::vector<Plane>& planes,
                        std::vector<const GeoNode*>& unions) {
        switch (node.kind) {
            case Kind::leaf: {
                const std::vector<Plane> outer = node.leaf->body.outer(node.leaf->map);
                planes.insert(planes.end(), outer.begin(), outer.end());
                return;
            }
            case Kind::all:
                for (const GeoSolid& child : node.children) collect(*child, planes, unions);
                return;
            case Kind::any:
                unions.push_back(&node);
                return;
            case Kind::complement:
                if (const GeoNode& inner = *node.children.front(); inner.leaf && inner.leaf->kind == "plane")
                    for (const Plane& plane : inner.leaf->body.outer(inner.leaf->map))
                        planes.emplace_back(plane.origin(), -plane.normal());
                return;
        }
    }

    AlignedBox3d world_;
};

class GeoModelMaker {
  public:
    explicit GeoModelMaker(const std::string& file) : file_(file) {}

    Model make(const std::vector<GeoObject>& objects) {
        if (objects.empty())
            throw InputError(fmt::format("{}: the model is empty: it has no top-level object (tlo)", file_));
        world_ = world_of(objects);
        std::vector<CsgTree> trees;
        for (const GeoObject& object : objects) trees.push_back(tree_of(object));
        model_.tree = combine(Operation::fragment, std::move(trees));
        shape_primitives();
        name_boundaries();
        return std::move(model_);
    }

  private:
    /// Of the file's primitives: where they are needed, and what they are called.
    struct Use {
        const GeoLeaf* leaf;  ///< null for the box of an object
        AlignedBox3d box;     ///< of all the objects that it is a part of
        bool is_owner = false;
    };

    /// Much larger than anything that has an end: what reaches as far has none.
    static AlignedBox3d world_of(const std::vector<GeoObject>& objects) {
        constexpr double times = 1e3;
        double extent = 0;
        for (const GeoObject& object : objects)
            for (const GeoLeaf* leaf : leaves_of(*object.solid))
                for (const Plane& plane : leaf->body.outer(leaf->map))
                    extent = std::max(extent, plane.origin().cwiseAbs().maxCoeff());
        const Point corner = Point::Constant(times * (extent > 0 ? extent : 1));
        return {-corner, corner};
    }

    CsgTree tree_of(const GeoObject& object) {
        const AlignedBox3d tight = Bounds(world_).of(*object.solid);
        const auto error = [&](std::string_view what) {
            return located_error(file_, object.at,
                                 fmt::format("the top-level object '{}' {}", object.name, what));
        };
        if (tight.isEmpty()) throw error("is empty");
        if (reaches(tight, world_))
            throw error("has no end: intersect planes, cylinders and cones with what bounds them");
        box_ = grown(tight, 1.0 / 16);
        object_ = &object;
        needs_box_ = false;
        n_nodes_ = 0;
        CsgTree tree = tree_of(*object.solid);
        std::vector<std::uint32_t> owners;
        collect_owners(tree, owners);
        if (owners.size() != 1 || uses_[owners[0]].is_owner) needs_box_ = true;
        if (needs_box_) {
            // The object's box owns all of it, so that it is one part, and ends what has no end.
            const std::uint32_t owner = object_box();
            owners = {owner};
            tree =
                combine(Operation::intersection, {{.operation = Operation::leaf, .primitive = owner}, tree});
        }
        uses_[owners[0]].is_owner = true;
        owners_.emplace_back(owners[0], &object);
        Primitive& owner = model_.primitives[owners[0]];
        owner.name = object.name;
        owner.material = object.material;
        return tree;
    }

    CsgTree tree_of(const GeoNode& node) {
        constexpr int most_nodes = 100'000;
        if (++n_nodes_ > most_nodes)
            throw located_error(file_, object_->at,
                                fmt::format("'{}' has more than {} primitives", object_->name, most_nodes));
        const auto leaf_of = [](std::uint32_t primitive) {
            return CsgTree{.operation = Operation::leaf, .primitive = primitive};
        };
        switch (node.kind) {
            case Kind::leaf:
                return leaf_of(primitive_of(*node.leaf));
            case Kind::any:
                return combine(Operation::join, trees_of(node.children));
            case Kind::complement:
                needs_box_ = true;
                return combine(Operation::difference,
                               {leaf_of(object_box()), tree_of(*node.children.front())});
            case Kind::all:
                break;
        }
        std::vector<CsgTree> together, without;
        for (const GeoSolid& child : node.children) {
            if (child->kind != Kind::complement) {
                together.push_back(tree_of(*child));
                continue;
            }
            const GeoNode& inner = *child->children.front();
            for (const GeoLeaf* leaf : leaves_of(inner)) needs_box_ |= leaf->body.is_endless;
            without.push_back(tree_of(inner));
        }
        if (together.empty()) {
            needs_box_ = true;
            together.push_back(leaf_of(object_box()));
        }
        CsgTree first = combine(Operation::intersection, std::move(together));
        if (without.empty()) return first;
        without.insert(without.begin(), std::move(first));
        return combine(Operation::difference, std::move(without));
    }

    std::vector<CsgTree> trees_of(const std::vector<GeoSolid>& nodes) {
        std::vector<CsgTree> trees;
        for (const GeoSolid& node : nodes) trees.push_back(tree_of(*node));
        return trees;
    }

    /// Objects share their primitives.
    std::uint32_t primitive_of(const GeoLeaf& leaf) {
        auto use = std::ranges::find(uses_, &leaf, &Use::leaf);
        if (use == uses_.end()) {
            use = uses_.insert(use, {.leaf = &leaf, .box = box_});
            model_.primitives.push_back(
                {.shape = nullptr, .name = leaf.name, .material = {}, .size = leaf.size});
        }
        use->box.extend(box_);
        const auto index = static_cast<std::uint32_t>(use - uses_.begin());
        double& size = model_.primitives[index].size;
        if (object_->size > 0) size = size > 0 ? std::min(size, object_->size) : object_->size;
        return index;
    }

    std::uint32_t object_box() {
        const auto [known, is_new] = boxes_.try_emplace(object_, static_cast<std::uint32_t>(uses_.size()));
        if (is_new) {
            uses_.push_back({.leaf = nullptr, .box = box_});
            model_.primitives.push_back(
                {.shape = make_cube(box_.sizes(), false, Eigen::Affine3d(Eigen::Translation3d(box_.min()))),
                 .name = object_->name,
                 .material = {},
                 .size = object_->size});
        }
        return known->second;
    }

    static void collect_owners(const CsgTree& tree, std::vector<std::uint32_t>& owners) {
        if (tree.operation == Operation::leaf && std::ranges::find(owners, tree.primitive) == owners.end())
            owners.push_back(tree.primitive);
        const bool first_only =
            tree.operation == Operation::intersection || tree.operation == Operation::difference;
        for (const CsgTree& child : tree.children) {
            collect_owners(child, owners);
            if (first_only) return;
        }
    }

    void shape_primitives() {
        for (std::size_t i = 0; i < uses_.size(); ++i) {
            const Use& use = uses_[i];
            if (use.leaf == nullptr) continue;
            const GeoLeaf& leaf = *use.leaf;
            Primitive& primitive = model_.primitives[i];
            try {
                primitive.shape = leaf.body.shape(leaf.map, use.box);
            } catch (const InputError& error) {
                throw located_error(file_, leaf.at, fmt::format("{}: {}", leaf.kind, error.what()));
            }
            for (const PrimitiveFace& face : primitive.shape->faces())
                primitive.surface_names.push_back(surface_name(use, face.name));
        }
    }

    static std::string surface_name(const Use& use, const std::string& face) {
        const GeoLeaf& leaf = *use.leaf;
        const auto number =
            static_cast<std::size_t>(std::ranges::find(leaf.body.faces, face) - leaf.body.faces.begin());
        if (number < leaf.sets.size() && !leaf.sets[number].empty()) return leaf.sets[number];
        return fmt::format("{}/{}", leaf.name, face);
    }

    /// By the objects' own boundary conditions.
    void name_boundaries() {
        const std::vector<ModelSurface> numbered = surfaces(model_);
        for (std::uint32_t i = 0; i < numbered.size(); ++i) {
            const GeoLeaf* leaf = uses_[numbered[i].primitive].leaf;
            if (leaf == nullptr) continue;
            for (const auto& [owner, object] : owners_)
                if (const auto set = object->sets.find(leaf); set != object->sets.end())
                    model_.primitives[owner].boundary_names[i] = set->second;
        }
    }

    const std::string& file_;
    AlignedBox3d world_;
    Model model_;
    std::vector<Use> uses_;  ///< one for each primitive
    std::map<const GeoObject*, std::uint32_t> boxes_;
    std::vector<std::pair<std::uint32_t, const GeoObject*>> owners_;  ///< primitives that own the objects
    // Of the object that is being made.
    const GeoObject* object_ = nullptr;
    AlignedBox3d box_;
    bool needs_box_ = false;
    int n_nodes_ = 0;
};

}  // namespace

Model parse_geo_model(std::string_view text, const std::string& name) {
    return GeoModelMaker(name).make(parse_geo(text, name));
}

}  // namespace maille::modeler
