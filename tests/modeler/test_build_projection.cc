#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "modeler/build.hh"
#include "modeler/build_projection.hh"
#include "modeler/model.hh"
#include "modeler/shapes.hh"
#include "tests/modeler/name_checks.hh"
#include "tests/refine/meshes.hh"
#include "volmesh/overlap.hh"
#include "volmesh/validate.hh"

namespace {

using namespace maille;
using namespace maille::modeler;
using Eigen::Vector3d;
using volmesh::EntityKind;

/// Bricks of tetrahedra, n to an edge, one for each box, which need not fill the cubes that they stand for.
class Bricks {
  public:
    explicit Bricks(int n) : n_(n) {}

    void add(const Vector3d& low, const Vector3d& high, const Vector3d& low_of_cube,
             const Vector3d& high_of_cube) {
        const ::test::Soup brick = ::test::kuhn_cube(n_);
        const auto first = static_cast<std::uint32_t>(soup_.points.size());
        for (const auto& p : brick.points) soup_.points.push_back(low + p.cwiseProduct(high - low));
        for (::test::Tet t : brick.tets) {
            for (auto& v : t) v += first;
            soup_.tets.push_back(t);
        }
        Eigen::Affine3d at = Eigen::Affine3d::Identity();
        at.translation() = low_of_cube;
        model_.primitives.push_back(
            {make_cube(high_of_cube - low_of_cube, false, at), "cube" + std::to_string(ends_.size()), "", 0});
        ends_.push_back(static_cast<std::uint32_t>(soup_.tets.size()));
        boxes_.emplace_back(low, high);
    }

    const Model& model() const { return model_; }

    /// The faces of each brick lie on the sides of its cube.
    Merged merged() const {
        Merged merged;
        merged.mesh = soup_.mesh();
        std::vector<volmesh::SetHandle> sets;
        for (const auto& surface : surfaces(model_))
            sets.push_back(merged.mesh.add_set(surface.name, EntityKind::face));
        for (const auto halfface : merged.mesh.boundary_halffaces()) {
            const volmesh::HalffaceHandle hf = halfface;
            const auto cube = static_cast<std::size_t>(
                std::ranges::upper_bound(ends_, merged.mesh.incident_cell(hf).idx()) - ends_.begin());
            Vector3d middle = Vector3d::Zero();
            for (const auto v : merged.mesh.halfface_vertices(hf)) middle += merged.mesh.point(v) / 3;
            const Vector3d out = (middle - boxes_[cube].center()).cwiseQuotient(boxes_[cube].sizes());
            Eigen::Index axis = 0;
            out.cwiseAbs().maxCoeff(&axis);
            const auto surface =
                static_cast<std::uint32_t>(6 * cube + 2 * static_cast<std::size_t>(axis) + (out[axis] > 0));
            merged.faces.push_back({hf, surface});
            merged.mesh.insert(sets[surface], hf);
        }
        return merged;
    }

  private:
    int n_;
    ::test::Soup soup_;
    std::vector<std::uint32_t> ends_;  ///< of each brick's tetrahedra
    std::vector<Eigen::AlignedBox3d> boxes_;
    Model model_;
};

double distance_from(const Merged& merged, const Model& model, std::uint32_t surface) {
    const ModelSurface named = surfaces(model)[surface];
    double farthest = 0;
    for (const InterfaceFace& face : merged.faces) {
        if (face.surface != surface) continue;
        for (const auto v : merged.mesh.halfface_vertices(face.face))
            farthest = std::max(farthest, std::abs(model.primitives[named.primitive].shape->face_implicit(
                                              named.face, merged.mesh.point(v))));
    }
    return farthest;
}

}  // namespace

TEST_CASE("new vertices that are off their surfaces are brought there, kept ones and their cells stay") {
    Bricks bricks(3);
    bricks.add({0.02, 0, 0}, {0.97, 1, 0.98}, {0, 0, 0}, {1, 1, 1});
    SUBCASE("all are new") {
        Merged merged = bricks.merged();
        const auto result = project_new_vertices(merged, projector(bricks.model()));
        CHECK(result.short_of_target.empty());
        CHECK(result.moved == 56 - 16);  // 16 are on none of the sides x-, x+ and z+
        for (std::uint32_t s = 0; s < 6; ++s) CHECK(distance_from(merged, bricks.model(), s) < 1e-12);
        CHECK(volmesh::validate(merged.mesh).ok());
    }
    SUBCASE("some were kept") {
        Merged merged = bricks.merged();
        const volmesh::TetMesh before = merged.mesh;
        merged.kept_vertices.n_base = 20;
        const auto result = project_new_vertices(merged, projector(bricks.model()));
        CHECK(result.moved > 20);
        for (std::uint32_t v = 0; v < 20; ++v) CHECK(merged.mesh.points()[v] == before.points()[v]);
    }
}

TEST_CASE("walls do not cross each other to reach their surfaces, and the vertices that stay are named") {
    Bricks bricks(2);
    bricks.add({0, 0, 0}, {0.9, 1, 1}, {0, 0, 0}, {1, 1, 1});
    bricks.add({0.95, -0.2, -0.2}, {1.98, 1.2, 1.2}, {0.95, -0.2, -0.2}, {2, 1.2, 1.2});
    Merged merged = bricks.merged();
    const auto result = project_new_vertices(merged, projector(bricks.model()));
    CHECK(volmesh::validate(merged.mesh).ok());
    CHECK(volmesh::find_overlaps(merged.mesh).empty());
    // The first cube's side x+ is within the second one.
    CHECK(result.short_of_target.size() == 9);
    for (const quality::ShortOfTarget& left : result.short_of_target) {
        CHECK(std::ranges::count(left.surfaces, "cube0/x+") == 1);
        CHECK(left.place == merged.mesh.point(left.vertex));
        REQUIRE(left.distance);
        CHECK(*left.distance == doctest::Approx(0.1));
        CHECK(left.off == doctest::Approx(0.1));
    }
    CHECK(distance_from(merged, bricks.model(), 7) < 1e-12);  // cube1/x+: nothing is in its way
}

TEST_CASE("corners that flat triangles would get wrong are on all their surfaces") {
    std::string text;
    std::vector<Vector3d> corners;
    SUBCASE("an edge within a sphere by less than the chords' error") {
        text = "difference() { sphere(r = 1, $fn = 32); translate([0.01, -2, 0.998]) cube([2, 4, 2]); }";
        const double half = std::sqrt(1 - 0.01 * 0.01 - 0.998 * 0.998);
        for (const double y : {-half, half}) corners.emplace_back(0.01, y, 0.998);
    }
    SUBCASE("a prism in a cylinder of the same radius") {
        text =
            "difference() { cylinder(h = 1, r1 = 1, r2 = 1, $fn = 32); "
            "translate([0, 0, 0.5]) prism(n = 5, r = 1, h = 1); }";
        for (int k = 0; k < 5; ++k) {
            const double angle = 2 * std::numbers::pi * k / 5;
            for (const double z : {0.5, 1.0}) corners.emplace_back(std::cos(angle), std::sin(angle), z);
        }
    }
    const Model model = parse_model(text, "part.csg", Facets::round);
    BuildReport report;
    const auto mesh = build(model, {}, &report);
    CHECK(volmesh::validate(mesh).ok());
    CHECK(report.projection.short_of_target.empty());
    const auto figures = modeler::test::check_names(mesh, model);
    CHECK(figures.nameless + figures.ambiguous == 0);
    CHECK(figures.farthest < 1e-12);
    for (const Vector3d& corner : corners)
        CHECK(std::ranges::any_of(mesh.points(), [&](const auto& p) { return (p - corner).norm() < 1e-9; }));
}
