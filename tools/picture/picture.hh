#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "volmesh/tet_mesh.hh"

namespace maille::picture {

using Plane = Eigen::Hyperplane<double, 3>;

struct PictureOptions {
    int width = 1280, height = 960;  ///< pixels, 16 to 16384
    /// From the mesh towards the eye; z is up in the picture.
    Eigen::Vector3d view{0.62, -1, 0.58};
    /// Cells whose centroid is on the positive side of every plane are left out, whole, so that those behind
    /// show. Not given: see front_cut(). An empty list: nothing is left out.
    std::optional<std::vector<Plane>> cut;
    bool legend = true;  ///< names of the cell sets and of the boundary's face sets
};

/// The upright plane through the middle of the mesh, across x or y, that parts the half nearer to the eye: of
/// the two the one that meets more cells, so that there is more to see.
Plane front_cut(const volmesh::TetMesh& mesh, const Eigen::Vector3d& view);

/// Draws the mesh in a PNG file, with ray tracing and without a display: cells in the colours of their cell
/// sets, the boundary in tints by face set, mesh edges as thin lines and the edges between face sets as
/// thicker ones.
///
/// The same mesh and options give the same bytes, for any number of threads. The file is written beside its
/// place and then renamed: there is never half a picture. Throws InputError where the mesh has no cell to
/// show, an option is out of range, or the file can't be written.
void write_picture(const volmesh::TetMesh& mesh, const std::filesystem::path& path,
                   const PictureOptions& options = {});

}  // namespace maille::picture
