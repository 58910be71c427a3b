#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "volmesh/tet_mesh.hh"

namespace maille::tools {

/// What can be said of a mesh in a few figures.
struct MeshInfo {
    struct Set {
        std::string name;
        volmesh::EntityKind kind;
        std::size_t size;
        double measure;  ///< volume, area, length or, for vertices, their number
    };

    std::uint32_t vertices, edges, faces, cells, boundary_faces;
    double volume, area;
    Eigen::AlignedBox3d bbox;
    std::size_t components;  ///< parts that are connected through faces
    std::int64_t euler;      ///< vertices - edges + faces - cells
    std::vector<Set> sets;   ///< by kind (cells, faces, edges, vertices), then in the mesh's order
};

/// Precondition: a mesh without deleted entities.
MeshInfo mesh_info(const volmesh::TetMesh& mesh);

nlohmann::ordered_json to_json(const MeshInfo& info);
std::string to_text(const MeshInfo& info);

}  // namespace maille::tools
