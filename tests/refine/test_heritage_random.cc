#include <cmath>
#include <random>

#include <doctest/doctest.h>

#include "meshes.hh"
#include "refine/refine.hh"
#include "refine/simplex_tree.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

// Random sets with random rules, and properties of random values, through random refinement, against an
// oracle that looks at the places of the refined entities in the mesh before, and at nothing else; only the
// ends that a vertex was born between, which `both_ends` asks for, come from the lineage.

using namespace maille::refine;
using maille::volmesh::EdgeHandle;
using maille::volmesh::EntityKind;
using maille::volmesh::FaceHandle;
using maille::volmesh::PropertyHeritage;
using maille::volmesh::PropertyRule;
using maille::volmesh::SetHandle;
using maille::volmesh::SetRule;

namespace {

Simplex simplex(const TetMesh& mesh, const auto& vertices) {
    Simplex s;
    for (const VertexHandle v : vertices) s.corners[s.n_corners++] = mesh.point(v);
    return s;
}

bool lies_in(const Simplex& inner, const Simplex& outer) {
    constexpr double rounding = 1e-20;
    for (int i = 0; i < inner.n_corners; ++i)
        if (nearest_on(outer, inner.corners[i]).squared_distance > rounding) return false;
    return true;
}
bool are_same(const Simplex& a, const Simplex& b) {
    return lies_in(a, b) && lies_in(b, a);
}

double size_of(const Simplex& s) {
    const auto& c = s.corners;
    if (s.n_corners == 2) return (c[1] - c[0]).norm();
    if (s.n_corners == 3) return maille::volmesh::triangle_area(c[0], c[1], c[2]);
    return maille::volmesh::tet_volume(c[0], c[1], c[2], c[3]);
}

/// The entities of one kind, as places.
std::vector<Simplex> places_of(const TetMesh& mesh, EntityKind kind) {
    std::vector<Simplex> all;
    switch (kind) {
        case EntityKind::vertex:
            for (const auto v : mesh.vertices()) all.push_back({{v.point()}, 1});
            break;
        case EntityKind::edge:
            for (const auto e : mesh.edges()) all.push_back(simplex(mesh, e.vertices()));
            break;
        case EntityKind::face:
            for (const auto f : mesh.faces()) all.push_back(simplex(mesh, f.vertices()));
            break;
        case EntityKind::cell:
            for (const auto c : mesh.cells()) all.push_back(simplex(mesh, c.vertices()));
            break;
    }
    return all;
}

bool contains(const TetMesh& mesh, SetHandle set, EntityKind kind, std::uint32_t i) {
    switch (kind) {
        case EntityKind::vertex:
            return mesh.contains(set, VertexHandle(i));
        case EntityKind::edge:
            return mesh.contains(set, EdgeHandle(i));
        case EntityKind::face:
            return mesh.contains(set, FaceHandle(i));
        case EntityKind::cell:
            return mesh.contains(set, CellHandle(i));
    }
    return false;
}

void insert(TetMesh& mesh, SetHandle set, EntityKind kind, std::uint32_t i) {
    switch (kind) {
        case EntityKind::vertex:
            return mesh.insert(set, VertexHandle(i));
        case EntityKind::edge:
            return mesh.insert(set, EdgeHandle(i));
        case EntityKind::face:
            return mesh.insert(set, FaceHandle(i));
        case EntityKind::cell:
            return mesh.insert(set, CellHandle(i));
    }
}

/// A set and what it was before.
struct RandomSet {
    SetHandle set;
    EntityKind kind;
    SetRule::Kind rule;
    std::vector<Simplex> members;
    std::optional<std::size_t> source{};  ///< place among the sets
    Point probe{};                        ///< custom rules keep what holds this point
};

constexpr EntityKind kinds[] = {EntityKind::vertex, EntityKind::edge, EntityKind::face, EntityKind::cell};

class RandomSets {
  public:
    RandomSets(TetMesh& mesh, std::mt19937& random) : random_(random) {
        for (int i = 0; i < 6; ++i)
            for (const EntityKind kind : {EntityKind::edge, EntityKind::face, EntityKind::cell})
                add(mesh, kind);
        for (int i = 0; i < 12; ++i) add_vertex_set(mesh);
    }
    const std::vector<RandomSet>& all() const { return sets_; }

  private:
    std::size_t pick(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_); }

    void add(TetMesh& mesh, EntityKind kind) {
        const std::vector<Simplex> places = places_of(mesh, kind);
        RandomSet s{{}, kind, SetRule::Kind::copy, {}};
        SetRule rule = SetRule::copy();
        switch (pick(3)) {
            case 0:
                rule = SetRule::none();
                break;
            case 1: {
                // The middle of a later part of some entity is no vertex of any refinement.
                const Simplex& at = places[pick(places.size())];
                Eigen::Vector4d weights(0.137, 0.281, 0.213, 0.369);
                weights /= weights.head(at.n_corners).sum();
                for (int i = 0; i < at.n_corners; ++i) s.probe += weights[i] * at.corners[i];
                rule = SetRule::custom([probe = s.probe](const TetMesh& m, auto entity, auto...) {
                    return lies_in({{probe}, 1}, simplex(m, entity));
                });
                break;
            }
            default:
                break;
        }
        fill(mesh, std::move(s), std::move(rule), places);
    }

    void add_vertex_set(TetMesh& mesh) {
        RandomSet s{{}, EntityKind::vertex, SetRule::Kind::none, {}};
        SetRule rule = SetRule::none();
        switch (pick(5)) {
            case 0:
                rule = SetRule::both_ends();
                break;
            case 1:
                s.source = source({EntityKind::edge, EntityKind::face, EntityKind::cell});
                rule = SetRule::both_ends(sets_[*s.source].set);
                break;
            case 2:
                s.source = source({EntityKind::edge});
                rule = SetRule::from_edges(sets_[*s.source].set);
                break;
            case 3:
                s.source = source({EntityKind::face});
                rule = SetRule::from_faces(sets_[*s.source].set);
                break;
            default:
                rule = SetRule::custom([](const TetMesh& m, auto, auto, auto, VertexHandle born) {
                    return m.point(born).x() > 0.6;
                });
        }
        fill(mesh, std::move(s), std::move(rule), places_of(mesh, EntityKind::vertex));
    }

    /// Some set of one of these kinds whose members pass on to their children.
    std::size_t source(std::vector<EntityKind> of) {
        std::vector<std::size_t> candidates;
        for (std::size_t i = 0; i < sets_.size(); ++i)
            if (std::ranges::count(of, sets_[i].kind) > 0 && sets_[i].rule == SetRule::Kind::copy)
                candidates.push_back(i);
        REQUIRE_FALSE(candidates.empty());
        return candidates[pick(candidates.size())];
    }

    void fill(TetMesh& mesh, RandomSet s, SetRule rule, const std::vector<Simplex>& places) {
        s.rule = rule.kind;
        // The first of each kind passes on, so that vertex sets have a source.
        const auto n_of_kind = std::ranges::count(sets_, s.kind, &RandomSet::kind);
        if (s.kind != EntityKind::vertex && n_of_kind == 0) {
            rule = SetRule::copy();
            s.rule = rule.kind;
        }
        s.set = mesh.add_set("set " + std::to_string(sets_.size()), s.kind, std::move(rule));
        const std::size_t one_in = 1 + pick(5);
        for (std::uint32_t i = 0; i < places.size(); ++i) {
            if (pick(one_in) != 0) continue;
            insert(mesh, s.set, s.kind, i);
            s.members.push_back(places[i]);
        }
        sets_.push_back(std::move(s));
    }

    std::mt19937& random_;
    std::vector<RandomSet> sets_;
};

/// Whether an entity of that place should be a member of a cell, face or edge set.
bool is_expected(const RandomSet& s, const Simplex& place) {
    for (const Simplex& member : s.members) {
        if (!lies_in(place, member)) continue;
        if (are_same(place, member)) return true;
        if (s.rule == SetRule::Kind::copy) return true;
        if (s.rule == SetRule::Kind::custom) return lies_in({{s.probe}, 1}, place);
    }
    return false;
}

/// Which vertices should be members of a vertex set.
std::vector<bool> expected_vertices(const TetMesh& mesh, const RandomSet& s,
                                    const std::vector<RandomSet>& all, const Lineage& lineage) {
    std::vector<bool> is_member(mesh.n_vertices());
    for (std::uint32_t i = 0; i < mesh.n_vertices(); ++i) {
        const Simplex place{{mesh.point(VertexHandle(i))}, 1};
        if (i < lineage.n_vertices_before) {
            is_member[i] =
                std::ranges::any_of(s.members, [&](const Simplex& m) { return are_same(place, m); });
            continue;
        }
        const auto [a, b] = lineage.vertex_parents[i - lineage.n_vertices_before];
        const Simplex edge{{mesh.point(VertexHandle(a)), mesh.point(VertexHandle(b))}, 2};
        const auto lies_in_source = [&](const Simplex& what) {
            return !s.source || std::ranges::any_of(all[*s.source].members,
                                                    [&](const Simplex& m) { return lies_in(what, m); });
        };
        switch (s.rule) {
            case SetRule::Kind::both_ends:
                is_member[i] = is_member[a] && is_member[b] && lies_in_source(edge);
                break;
            case SetRule::Kind::from_edges:
            case SetRule::Kind::from_faces:
                is_member[i] = lies_in_source(place);
                break;
            case SetRule::Kind::custom:
                is_member[i] = place.corners[0].x() > 0.6;
                break;
            default:
                break;
        }
    }
    return is_member;
}

void check_sets(const TetMesh& mesh, const std::vector<RandomSet>& sets, const Lineage& lineage) {
    for (const EntityKind kind : {EntityKind::edge, EntityKind::face, EntityKind::cell}) {
        const std::vector<Simplex> places = places_of(mesh, kind);
        for (const RandomSet& s : sets) {
            if (s.kind != kind) continue;
            CAPTURE(mesh.set_info(s.set).name);
            CAPTURE(int(kind));
            CAPTURE(int(s.rule));
            std::size_t n_wrong = 0;
            for (std::uint32_t i = 0; i < places.size(); ++i)
                n_wrong += contains(mesh, s.set, kind, i) != is_expected(s, places[i]);
            CHECK(n_wrong == 0);
        }
    }
    for (const RandomSet& s : sets) {
        if (s.kind != EntityKind::vertex) continue;
        CAPTURE(mesh.set_info(s.set).name);
        CAPTURE(int(s.rule));
        const std::vector<bool> expected = expected_vertices(mesh, s, sets, lineage);
        std::size_t n_wrong = 0;
        for (std::uint32_t i = 0; i < expected.size(); ++i)
            n_wrong += mesh.contains(s.set, VertexHandle(i)) != expected[i];
        CHECK(n_wrong == 0);
    }
}

/// The entity before that a place lies in, if there is one.
std::optional<std::uint32_t> ancestor(const std::vector<Simplex>& before, const Simplex& place) {
    for (std::uint32_t i = 0; i < before.size(); ++i)
        if (lies_in(place, before[i])) return i;
    return std::nullopt;
}

/// Values by entity before; each property of the three is of the same values under another rule.
template <class Property>
struct Properties {
    Property shared, copied, kept;
    std::vector<double> values;
};

template <class Property, class Handle>
Properties<Property> add_properties(TetMesh& mesh, std::uint32_t n, std::mt19937& random) {
    Properties<Property> p;
    mesh.add_property(p.shared, "shared", {PropertyRule::share});
    mesh.add_property(p.copied, "copied", {PropertyRule::copy}, -1.0);
    mesh.add_property(p.kept, "kept", {PropertyRule::none}, -2.0);
    std::uniform_real_distribution<double> value(0, 10);
    for (std::uint32_t i = 0; i < n; ++i) {
        p.values.push_back(value(random));
        for (const Property& each : {p.shared, p.copied, p.kept})
            mesh.property(each, Handle(i)) = p.values[i];
    }
    return p;
}

template <class Handle, class Property>
void check_properties(const TetMesh& mesh, const Properties<Property>& p, const std::vector<Simplex>& before,
                      const std::vector<Simplex>& after) {
    std::vector<double> sums(before.size());
    for (std::uint32_t i = 0; i < after.size(); ++i) {
        const auto whole = ancestor(before, after[i]);
        const double shared = mesh.property(p.shared, Handle(i)), copied = mesh.property(p.copied, Handle(i)),
                     kept = mesh.property(p.kept, Handle(i));
        if (!whole) {
            CHECK(shared == 0);
            CHECK(copied == -1);
            CHECK(kept == -2);
            continue;
        }
        const double part = size_of(after[i]) / size_of(before[*whole]);
        CHECK(shared == doctest::Approx(p.values[*whole] * part).epsilon(1e-9));
        CHECK(copied == p.values[*whole]);
        CHECK(kept == (are_same(after[i], before[*whole]) ? p.values[*whole] : -2));
        sums[*whole] += shared;
    }
    for (std::uint32_t i = 0; i < before.size(); ++i)
        CHECK(sums[i] == doctest::Approx(p.values[i]).epsilon(1e-12));
}

RefineOptions random_options(std::mt19937& random) {
    const auto pick = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
    constexpr Order orders[] = {Order::longest, Order::shape, Order::none};
    return {.method = pick(2) == 0 ? Method::rivara : Method::bisection,
            .order = orders[pick(3)],
            .max_iterations = 3 + pick(4),
            .max_cells = 700};
}

SizeField random_size(std::mt19937& random) {
    std::uniform_real_distribution<double> u(0, 1);
    const Point center(u(random), u(random), u(random));
    return SizeField([center](const Point& p) { return 0.05 + 0.5 * (p - center).norm(); });
}

}  // namespace

TEST_CASE("random sets of random rules are where geometry says after random refinement") {
    for (unsigned seed = 1; seed <= 10; ++seed) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        TetMesh mesh = test::random_cube(2, seed, 0.25).mesh();
        const RandomSets sets(mesh, random);
        const RefineOptions options = random_options(random);
        CAPTURE(int(options.method));
        const RefineResult result = refine(mesh, random_size(random), options);
        CHECK(mesh.n_cells() > 100);
        CHECK(maille::volmesh::validate(mesh).ok());
        check_sets(mesh, sets.all(), result.lineage);
    }
}

TEST_CASE("random values are copied, kept and shared as geometry says after random refinement") {
    for (unsigned seed = 11; seed <= 16; ++seed) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        TetMesh mesh = test::random_cube(2, seed, 0.25).mesh();
        const TetMesh before = mesh;
        const auto cells =
            add_properties<maille::volmesh::CPropHandleT<double>, CellHandle>(mesh, mesh.n_cells(), random);
        const auto faces =
            add_properties<maille::volmesh::FPropHandleT<double>, FaceHandle>(mesh, mesh.n_faces(), random);
        const auto edges =
            add_properties<maille::volmesh::EPropHandleT<double>, EdgeHandle>(mesh, mesh.n_edges(), random);
        const std::vector<Simplex> faces_before = places_of(mesh, EntityKind::face),
                                   edges_before = places_of(mesh, EntityKind::edge),
                                   cells_before = places_of(mesh, EntityKind::cell);
        maille::volmesh::VPropHandleT<double> interpolated;
        mesh.add_property(interpolated, "interpolated", {PropertyRule::interpolate});
        for (const VertexHandle v : mesh.vertices())
            mesh.property(interpolated, v) = std::uniform_real_distribution<double>(0, 1)(random);
        const TetMesh start = mesh;
        refine(mesh, random_size(random), random_options(random));

        check_properties<CellHandle>(mesh, cells, cells_before, places_of(mesh, EntityKind::cell));
        check_properties<FaceHandle>(mesh, faces, faces_before, places_of(mesh, EntityKind::face));
        check_properties<EdgeHandle>(mesh, edges, edges_before, places_of(mesh, EntityKind::edge));
        for (const VertexHandle v : mesh.vertices()) {
            const auto cell = ancestor(cells_before, {{mesh.point(v)}, 1});
            REQUIRE(cell.has_value());
            const auto weights = nearest_on(cells_before[*cell], mesh.point(v)).weights;
            double expected = 0;
            for (int i = 0; i < 4; ++i)
                expected +=
                    weights[i] * start.property(interpolated, start.cell_vertex(CellHandle(*cell), i));
            CHECK(mesh.property(interpolated, v) == doctest::Approx(expected).epsilon(1e-9));
        }
    }
}
