#include <cstdlib>
#include <optional>
#include <random>
#include <string>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "modeler/build.hh"
#include "modeler/shapes.hh"
#include "tests/modeler/arrange_checks.hh"
#include "tests/modeler/name_checks.hh"
#include "volmesh/error.hh"
#include "volmesh/measure.hh"
#include "volmesh/validate.hh"

namespace {

using namespace maille;
using namespace maille::modeler;
using Eigen::Vector3d;
using volmesh::EntityKind;
using volmesh::TetMesh;

constexpr double size = 0.35;
/// Further than flat faces lie from the surfaces that they stand for.
constexpr double clearance = 0.06;

int number_from(const char* variable, int otherwise) {
    const char* text = std::getenv(variable);
    return text != nullptr ? std::atoi(text) : otherwise;
}

/// Solids of all kinds in a box of some 3 x 3 x 3; on a grid of halves so that faces and edges coincide.
class Generator {
  public:
    explicit Generator(unsigned seed) : random_(seed), on_grid_(seed % 3 == 0) {}

    Model model() {
        Model model;
        const auto n = static_cast<std::uint32_t>(2 + random_() % 11);
        for (std::uint32_t i = 0; i < n; ++i)
            model.primitives.push_back({shape(), "p" + std::to_string(i), "", 0});
        model.tree = test::random_tree(random_, 0, n);
        return model;
    }

    Vector3d place() { return {number(-1, 3), number(-1, 3), number(-1, 3)}; }

  private:
    double number(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    double length() { return on_grid_ ? 0.5 * static_cast<double>(1 + random_() % 3) : number(0.4, 1.5); }

    Eigen::Affine3d frame() {
        Eigen::Affine3d frame = Eigen::Affine3d::Identity();
        for (int k = 0; k < 3; ++k)
            frame.translation()[k] = on_grid_ ? 0.5 * static_cast<double>(random_() % 4) : number(0, 1.7);
        if (on_grid_) {
            Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
            const int axis = static_cast<int>(random_() % 3);
            for (int k = 0; k < 3; ++k) turn((axis + k) % 3, k) = 1;
            frame.linear() = turn;
        } else {
            frame.rotate(
                Eigen::AngleAxisd(number(0, 3), Vector3d(number(-1, 1), number(-1, 1), 1).normalized()));
        }
        return frame;
    }

    std::shared_ptr<const Shape> shape() {
        const Eigen::Affine3d at = frame();
        const double a = length(), b = length(), c = length();
        switch (random_() % 6) {
            case 0:
                return make_sphere(a, at);
            case 1:
                return make_cylinder(a, b, c, true, at);
            case 2:
                return make_cylinder(a, b, b, true, at);
            case 3:
                return make_prism(3 + static_cast<int>(random_() % 4), a, b, at);
            default:
                return make_cube({a, b, c}, random_() % 2 == 0, at);
        }
    }

    std::mt19937 random_;
    bool on_grid_;
};

/// Who owns the place, or nothing in either way: `is_sure` is false near any surface.
struct Place {
    bool is_sure = true;
    std::optional<std::uint32_t> owner;
};

Place look_at(const Model& model, const Vector3d& p) {
    Place place;
    for (const Primitive& primitive : model.primitives)
        place.is_sure = place.is_sure && std::abs(primitive.shape->implicit(p)) > clearance;
    place.owner = owner(model.tree, [&](std::uint32_t i) { return model.primitives[i].shape->contains(p); });
    return place;
}

/// The primitive that the cell's sets name.
std::optional<std::uint32_t> named_owner(const TetMesh& mesh, const Model& model, volmesh::CellHandle c) {
    std::optional<std::uint32_t> found;
    for (std::uint32_t i = 0; i < model.primitives.size(); ++i) {
        const auto set = mesh.find_set(model.primitives[i].name, EntityKind::cell);
        if (!set.is_valid() || !mesh.contains(set, c)) continue;
        CHECK_FALSE(found);
        found = i;
    }
    return found;
}

bool holds(const std::array<Vector3d, 4>& t, const Vector3d& p) {
    const auto side = [](const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
        return (b - a).cross(c - a).dot(d - a) >= 0;
    };
    return side(p, t[1], t[2], t[3]) && side(t[0], p, t[2], t[3]) && side(t[0], t[1], p, t[3]) &&
           side(t[0], t[1], t[2], p);
}

void check_cells(const TetMesh& mesh, const Model& model) {
    for (const auto c : mesh.cells()) {
        const auto p = mesh.cell_points(c);
        const Place place = look_at(model, (p[0] + p[1] + p[2] + p[3]) / 4);
        const auto named = named_owner(mesh, model, c);
        CHECK(named);
        if (place.is_sure) CHECK(named == place.owner);
    }
}

void check_places(const TetMesh& mesh, const Model& model, Generator& generator) {
    for (int i = 0; i < 100; ++i) {
        const Vector3d p = generator.place();
        const Place place = look_at(model, p);
        if (!place.is_sure) continue;
        std::optional<std::uint32_t> found;
        for (const auto c : mesh.cells())
            if (holds(mesh.cell_points(c), p)) found = named_owner(mesh, model, c);
        CHECK(found == place.owner);
    }
}

bool is_flat(const Primitive& primitive) {
    return std::ranges::all_of(primitive.shape->faces(), &PrimitiveFace::planar);
}

/// Between what the volume must lie, by one random point in each box of a grid. Those just within a curved
/// surface may be cut off by the flat faces that stand for it; four standard deviations are put on top.
std::array<double, 2> volume_bounds(const Model& model, unsigned seed) {
    constexpr int n = 60;
    Eigen::AlignedBox3d around;
    for (const Primitive& primitive : model.primitives) around.extend(primitive.shape->bounding_box());
    const Vector3d step = around.sizes() / n;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> part(0, 1);
    double inside = 0, doubtful = 0, near_surfaces = 0;
    std::vector<double> depth(model.primitives.size());
    for (int i = 0; i < n * n * n; ++i) {
        const Vector3d at(i % n + part(random), i / n % n + part(random), i / (n * n) + part(random));
        const Vector3d p = around.min() + step.cwiseProduct(at);
        bool is_near = false, is_doubtful = false;
        for (std::size_t k = 0; k < depth.size(); ++k) {
            depth[k] = -model.primitives[k].shape->implicit(p);
            is_near = is_near || std::abs(depth[k]) < 1.5 * step.norm();
            is_doubtful =
                is_doubtful || (depth[k] > 0 && depth[k] < clearance && !is_flat(model.primitives[k]));
        }
        near_surfaces += is_near;
        doubtful += is_doubtful;
        inside += !is_doubtful && owner(model.tree, [&](std::uint32_t k) { return depth[k] >= 0; });
    }
    const double error = 2 * std::sqrt(near_surfaces);
    return {(inside - error) * step.prod(), (inside + doubtful + error) * step.prod()};
}

void check_volume(const TetMesh& mesh, const Model& model, unsigned seed) {
    const auto [low, high] = volume_bounds(model, seed);
    CHECK(volmesh::volume(mesh) >= low);
    CHECK(volmesh::volume(mesh) <= high);
}

void check_surfaces(const TetMesh& mesh, const Model& model, const BuildReport& report) {
    const auto figures = test::check_names(mesh, model, report.projection.short_of_target);
    CHECK(figures.nameless == 0);
    CHECK(figures.ambiguous == 0);
    CHECK(figures.farthest < 1e-11);
    CHECK(figures.farthest_short < clearance);
}

}  // namespace

// MAILLE_TREES tells how many, MAILLE_TREES_SEED where to begin.
TEST_CASE("random trees of solids are filled as the tree says, everywhere") {
    const int count = number_from("MAILLE_TREES", 30), first = number_from("MAILLE_TREES_SEED", 1);
    int refused = 0;
    std::size_t n_short = 0;
    for (int seed = first; seed < first + count; ++seed) {
        CAPTURE(seed);
        Generator generator(static_cast<unsigned>(seed));
        const Model model = generator.model();
        TetMesh mesh;
        BuildReport report;
        try {
            mesh = build(model, {.size = size}, &report);
        } catch (const InputError& error) {
            if (std::string(error.what()).find("the model is empty") == std::string::npos) {
                MESSAGE("seed " << seed << " refused: " << error.what());
                ++refused;
                continue;
            }
        }
        CHECK(volmesh::validate(mesh).ok());
        check_cells(mesh, model);
        check_places(mesh, model, generator);
        check_volume(mesh, model, static_cast<unsigned>(seed));
        check_surfaces(mesh, model, report);
        n_short += report.projection.short_of_target.size();
    }
    CHECK(refused <= count / 200);
    if (n_short > 0) MESSAGE(n_short << " vertices are short of their surfaces, and named");
    CHECK(n_short <= static_cast<std::size_t>(count) / 2);
}
