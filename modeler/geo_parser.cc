#include "modeler/geo_parser.hh"

#include <algorithm>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "modeler/arguments.hh"
#include "modeler/geo_primitives.hh"

namespace maille::modeler {
namespace {

constexpr int most_copies = 10'000;
constexpr int deepest_nesting = 200;  // each level takes three calls

/// What stands after `-name=`.
struct Flag {
    Location at{};
    std::vector<double> numbers{};
    std::vector<std::string> words{};
    bool is_list = false;
};
using Flags = std::map<std::string, Flag, std::less<>>;

/// As Netgen has it: Euler's angles in radians, first about z, then x, then z again, each clockwise.
Eigen::Affine3d rotation(const Point& centre, const Point& angles) {
    const auto turn = [](double angle, const Point& axis) { return Eigen::AngleAxisd(-angle, axis); };
    const Eigen::Matrix3d linear =
        (turn(angles[2], Point::UnitZ()) * turn(angles[1], Point::UnitX()) * turn(angles[0], Point::UnitZ()))
            .toRotationMatrix();
    return Eigen::Translation3d(centre) * Eigen::Affine3d(linear) * Eigen::Translation3d(-centre);
}

GeoSolid combined(GeoNode::Kind kind, std::vector<GeoSolid> children) {
    if (children.size() == 1 && kind != GeoNode::Kind::complement) return children.front();
    return std::make_shared<GeoNode>(GeoNode{.kind = kind, .children = std::move(children)});
}

/// Copies of a solid, with primitives of their own.
class Mover {
  public:
    explicit Mover(const Eigen::Affine3d& map) : map_(map) {}

    GeoSolid operator()(const GeoSolid& solid) {
        GeoSolid& copy = copies_[solid.get()];
        if (copy) return copy;
        GeoNode node = *solid;
        for (GeoSolid& child : node.children) child = (*this)(child);
        if (node.leaf) {
            auto& leaf = leaves_[node.leaf.get()];
            if (!leaf) {
                leaf = std::make_shared<GeoLeaf>(*node.leaf);
                leaf->map = map_ * leaf->map;
                leaf->name.clear();
            }
            node.leaf = leaf;
        }
        return copies_[solid.get()] = std::make_shared<GeoNode>(std::move(node));
    }

  private:
    Eigen::Affine3d map_;
    std::map<const GeoNode*, GeoSolid> copies_;
    std::map<const GeoLeaf*, std::shared_ptr<GeoLeaf>> leaves_;
};

class GeoParser {
  public:
    GeoParser(std::string_view text, const std::string& file) : scanner_(text, file) {}

    std::vector<GeoObject> parse() {
        if (!scanner_.accept("algebraic3d")) throw scanner_.expected("'algebraic3d'");
        while (!scanner_.at_end()) statement();
        for (const auto& [at, words] : conditions_) apply_condition(at, words);
        return std::move(objects_);
    }

  private:
    struct Condition {
        Location at;
        std::array<std::string, 3> words;  ///< solid, object, set
    };

    void statement() {
        const Location at = scanner_.current().at;
        const std::string word = scanner_.word("a statement");
        if (word == "solid") return define_solid();
        if (word == "tlo") return add_object(at);
        if (word == "curve2d") return define_curve(curves_.flat);
        if (word == "curve3d") return define_curve(curves_.spatial);
        if (word == "boundarycondition") return add_condition(at, true);
        if (word == "boundaryconditionname") return add_condition(at, false);
        if (word == "boundingbox") {
            scanner_.expect('(');
            scanner_.vector();
            scanner_.expect(';');
            scanner_.vector();
            scanner_.expect(')');
        } else if (word == "define") {
            if (!scanner_.accept("constant")) throw scanner_.expected("'constant'");
            scanner_.word("a name");
            scanner_.expect('=');
            scanner_.number();
            scanner_.accept(';');
            return;
        } else if (word == "singular") {
            skip_singular();
        } else if (word == "identify" || word == "point") {
            throw scanner_.error(at, fmt::format("'{}' is not supported", word));
        } else {
            constexpr std::string_view statements[] = {
                "solid",       "tlo",    "curve2d", "curve3d", "boundarycondition", "boundaryconditionname",
                "boundingbox", "define", "singular"};
            throw scanner_.error(at,
                                 fmt::format("unknown statement '{}'{}", word, suggestion(word, statements)));
        }
        scanner_.expect(';');
    }

    /// Asks for refinement towards a face, edge or corner: no matter of geometry.
    void skip_singular() {
        const int n = scanner_.accept("face")    ? 2
                      : scanner_.accept("edge")  ? 2
                      : scanner_.accept("point") ? 3
                                                 : 0;
        if (n == 0) throw scanner_.expected("'face', 'edge' or 'point'");
        for (int i = 0; i < n; ++i) scanner_.word("the name of a solid");
        flags({"factor", "maxh", "tlo"});
    }

    template <int N>
    void define_curve(std::map<std::string, GeoCurve<N>, std::less<>>& curves) {
        const std::string name = scanner_.word("the name of a curve");
        scanner_.expect('=');
        curves[name] = read_geo_curve<N>(scanner_);
        scanner_.expect(';');
    }

    void define_solid() {
        const std::string name = new_name();
        scanner_.expect('=');
        const GeoSolid solid = any_of();
        const Flags given = flags({"maxh", "bc", "bcname", "col", "transparent", "layer"});
        scanner_.expect(';');
        name_leaves(*solid, name);
        apply(given, *solid);
        solids_[name] = solid;
        if (const auto maxh = given.find("maxh"); maxh != given.end())
            sizes_[name] = positive(maxh->second, "maxh");
    }

    std::string new_name() {
        const Location at = scanner_.current().at;
        const std::string name = scanner_.word("the name of a solid");
        if (std::ranges::find(reserved, name) != std::end(reserved))
            throw scanner_.error(at, fmt::format("'{}' is a word of the language, not a name", name));
        return name;
    }

    static constexpr std::string_view reserved[] = {
        "and", "or", "not", "solid", "tlo", "translate", "rotate", "multitranslate", "multirotate"};

    /// Called by the solid that they are first a part of, and numbered by kind if they are several.
    static void name_leaves(const GeoNode& solid, const std::string& name) {
        std::vector<GeoLeaf*> fresh = leaves_of(solid);
        std::erase_if(fresh, [](const GeoLeaf* leaf) { return !leaf->name.empty(); });
        std::map<std::string, int> count;
        for (GeoLeaf* leaf : fresh)
            leaf->name =
                fresh.size() == 1 ? name : fmt::format("{}.{}{}", name, leaf->kind, ++count[leaf->kind]);
    }

    /// As in Netgen, what a primitive has by an earlier statement stays; the smallest maxh holds.
    void apply(const Flags& given, const GeoNode& solid) const {
        if (const auto maxh = given.find("maxh"); maxh != given.end()) {
            const double size = positive(maxh->second, "maxh");
            for (GeoLeaf* leaf : leaves_of(solid))
                leaf->size = leaf->size > 0 ? std::min(leaf->size, size) : size;
        }
        for (const char* name : {"bcname", "bc"})
            if (const auto flag = given.find(name); flag != given.end())
                apply_sets(flag->second, name, solid);
    }

    void apply_sets(const Flag& flag, std::string_view name, const GeoNode& solid) const {
        std::vector<std::string> sets = flag.words;
        for (const double number : flag.numbers) sets.push_back(fmt::format("bc{}", number));
        if ((name == "bc" && !flag.words.empty()) || sets.empty())
            throw scanner_.error(flag.at,
                                 fmt::format("'{}' needs a {}", name, name == "bc" ? "number" : "name"));
        std::vector<std::string*> places;
        for (GeoLeaf* leaf : leaves_of(solid)) {
            leaf->sets.resize(leaf->body.faces.size());
            for (std::string& set : leaf->sets) places.push_back(&set);
        }
        if (flag.is_list && sets.size() != places.size())
            throw scanner_.error(flag.at, fmt::format("'{}' lists {} surfaces, but the solid has {}", name,
                                                      sets.size(), places.size()));
        for (std::size_t i = 0; i < places.size(); ++i)
            if (places[i]->empty()) *places[i] = flag.is_list ? sets[i] : sets.front();
    }

    double positive(const Flag& flag, std::string_view name) const {
        if (flag.is_list || flag.numbers.size() != 1 || !(flag.numbers[0] > 0))
            throw scanner_.error(flag.at, fmt::format("'{}' needs a number greater than 0", name));
        return flag.numbers[0];
    }

    void add_object(Location at) {
        GeoObject object{.name = {}, .at = scanner_.current().at, .solid = {}};
        object.name = scanner_.word("the name of a solid");
        object.solid = find(object.name, object.at);
        if (scanner_.current().kind == TokenKind::identifier)
            throw scanner_.error(at, "a surface as top-level object is not supported");
        const Flags given = flags({"material", "maxh", "col", "transparent", "layer"});
        scanner_.expect(';');
        if (const auto material = given.find("material"); material != given.end()) {
            if (material->second.words.size() != 1 || material->second.is_list)
                throw scanner_.error(material->second.at, "'material' needs a name");
            object.material = material->second.words[0];
        }
        if (const auto size = sizes_.find(object.name); size != sizes_.end()) object.size = size->second;
        if (const auto maxh = given.find("maxh"); maxh != given.end()) {
            const double size = positive(maxh->second, "maxh");
            object.size = object.size > 0 ? std::min(object.size, size) : size;
        }
        if (std::ranges::find(objects_, object.name, &GeoObject::name) != objects_.end())
            throw scanner_.error(object.at, fmt::format("'{}' is a top-level object already", object.name));
        objects_.push_back(std::move(object));
    }

    void add_condition(Location at, bool by_number) {
        Condition condition{.at = at, .words = {}};
        condition.words[0] = scanner_.word("the name of a solid");
        condition.words[1] = scanner_.word("the name of a top-level object");
        condition.words[2] = by_number ? fmt::format("bc{}", scanner_.number())
                                       : scanner_.word("the name of a boundary condition");
        scanner_.expect(';');
        conditions_.push_back(std::move(condition));
    }

    void apply_condition(Location at, const std::array<std::string, 3>& names) {
        const GeoSolid solid = find(names[0], at);
        const auto object = std::ranges::find(objects_, names[1], &GeoObject::name);
        if (object == objects_.end())
            throw scanner_.error(at, fmt::format("there is no top-level object '{}'", names[1]));
        for (const GeoLeaf* leaf : leaves_of(*solid)) object->sets[leaf] = names[2];
    }

    GeoSolid find(std::string_view name, Location at) const {
        const auto found = solids_.find(name);
        if (found != solids_.end()) return found->second;
        std::vector<std::string_view> known = geo_primitive_names();
        for (const auto& [other, solid] : solids_) known.push_back(other);
        throw scanner_.error(at, fmt::format("there is no solid '{}'{}", name, suggestion(name, known)));
    }

    GeoSolid any_of() {
        std::vector<GeoSolid> children{all_of()};
        while (scanner_.accept("or")) children.push_back(all_of());
        return combined(GeoNode::Kind::any, std::move(children));
    }

    GeoSolid all_of() {
        std::vector<GeoSolid> children{primary()};
        while (scanner_.accept("and")) children.push_back(primary());
        return combined(GeoNode::Kind::all, std::move(children));
    }

    GeoSolid primary() {
        if (++depth_ > deepest_nesting)
            throw scanner_.error(fmt::format("nested deeper than {} levels", deepest_nesting));
        GeoSolid result;
        const Location at = scanner_.current().at;
        if (scanner_.accept("not")) {
            result = combined(GeoNode::Kind::complement, {primary()});
        } else if (scanner_.accept('(')) {
            result = any_of();
            scanner_.expect(')');
        } else {
            result = named(scanner_.word("a solid"), at);
        }
        --depth_;
        return result;
    }

    GeoSolid named(const std::string& word, Location at) {
        if (word == "translate" || word == "multitranslate" || word == "rotate" || word == "multirotate")
            return moved(word);
        if (auto body = read_geo_primitive(word, scanner_, curves_)) {
            const auto leaf =
                std::make_shared<GeoLeaf>(GeoLeaf{.body = *std::move(body), .at = at, .kind = word});
            return std::make_shared<GeoNode>(GeoNode{.leaf = leaf});
        }
        return find(word, at);
    }

    /// `multitranslate` has the solid itself and n copies more, `multirotate` n in all: so it is in Netgen.
    GeoSolid moved(const std::string& word) {
        scanner_.expect('(');
        const bool turns = word.ends_with("rotate"), several = word.starts_with("multi");
        const Point first = scanner_.vector();
        scanner_.expect(';');
        Point angles = Point::Zero();
        if (turns) {
            angles = scanner_.vector();
            scanner_.expect(';');
        }
        int n = 1;
        if (several) {
            n = scanner_.count(1, most_copies);
            scanner_.expect(';');
        }
        const GeoSolid solid = any_of();
        scanner_.expect(')');
        const Eigen::Affine3d step =
            turns ? rotation(first, angles) : Eigen::Affine3d(Eigen::Translation3d(first));
        if (!several) return Mover(step)(solid);
        std::vector<GeoSolid> all{solid};
        Eigen::Affine3d map = step;
        for (int i = turns ? 2 : 1; i <= n; ++i, map = step * map) all.push_back(Mover(map)(solid));
        return combined(GeoNode::Kind::any, std::move(all));
    }

    Flags flags(std::initializer_list<std::string_view> known) {
        Flags result;
        while (scanner_.accept('-')) {
            const Location at = scanner_.current().at;
            const std::string name = scanner_.word("a flag");
            if (std::ranges::find(known, name) == known.end())
                throw scanner_.error(at,
                                     fmt::format("unknown flag '{}'{}", name,
                                                 suggestion(name, std::span(known.begin(), known.size()))));
            const auto [flag, is_new] = result.emplace(name, Flag{.at = at});
            if (!is_new) throw scanner_.error(at, fmt::format("'{}' is given twice", name));
            if (!scanner_.accept('=')) continue;
            flag->second.is_list = scanner_.accept('[');
            do value_into(flag->second);
            while (flag->second.is_list && scanner_.accept(','));
            if (flag->second.is_list) scanner_.expect(']');
        }
        return result;
    }

    void value_into(Flag& flag) {
        if (scanner_.current().kind == TokenKind::identifier)
            flag.words.push_back(scanner_.word("a value"));
        else
            flag.numbers.push_back(scanner_.number());
    }

    GeoScanner scanner_;
    GeoCurves curves_;
    std::map<std::string, GeoSolid, std::less<>> solids_;
    std::map<std::string, double, std::less<>> sizes_;  ///< the maxh of solids
    std::vector<GeoObject> objects_;
    std::vector<Condition> conditions_;
    int depth_ = 0;
};

}  // namespace

std::vector<GeoLeaf*> leaves_of(const GeoNode& solid) {
    std::vector<GeoLeaf*> leaves;
    std::set<const void*> seen;
    const auto visit = [&](const GeoNode& node, const auto& self) -> void {
        if (!seen.insert(&node).second) return;
        if (node.leaf && seen.insert(node.leaf.get()).second) leaves.push_back(node.leaf.get());
        for (const GeoSolid& child : node.children) self(*child, self);
    };
    visit(solid, visit);
    return leaves;
}

std::vector<GeoObject> parse_geo(std::string_view text, const std::string& file) {
    return GeoParser(text, file).parse();
}

}  // namespace maille::modeler
