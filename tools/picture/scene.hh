#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "tools/picture/color.hh"
#include "tools/picture/picture.hh"

namespace maille::picture {

/// What can be seen of a mesh: the outer faces of the cells that are left in, in coordinates where the mesh
/// fills the unit ball.
struct Scene {
    struct Triangle {
        std::array<std::uint32_t, 3> corners;
        Color color;
        /// Side k runs from corner k to the next: whether two face sets meet there.
        std::array<bool, 3> is_crease{};
    };
    struct LegendEntry {
        Color color;
        std::string name;
    };

    std::vector<Eigen::Vector3f> points;
    std::vector<Triangle> triangles;
    std::vector<LegendEntry> legend;
};

Scene make_scene(const volmesh::TetMesh& mesh, const std::vector<Plane>& cut);

}  // namespace maille::picture
