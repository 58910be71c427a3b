#include "tools/picture/picture.hh"

#include <cmath>

#include <fmt/format.h>

#include "tools/picture/camera.hh"
#include "tools/picture/image.hh"
#include "tools/picture/legend.hh"
#include "tools/picture/render.hh"
#include "tools/picture/scene.hh"
#include "volmesh/error.hh"

namespace maille::picture {
namespace {

void check(const PictureOptions& options) {
    for (int size : {options.width, options.height})
        if (size < 16 || size > 16384)
            throw InputError(fmt::format("a picture of {} x {} pixels: each must be 16 to 16384",
                                         options.width, options.height));
    if (!options.view.allFinite() || options.view.isZero())
        throw InputError("a picture's view must be a direction: finite, and not zero");
}

/// The image without the legend's column and a margin.
Frame frame_beside(int legend, const Image& image) {
    const float margin = 0.05F * static_cast<float>(std::min(image.width, image.height));
    // However long the names are, half the image is the mesh's.
    const auto width = static_cast<float>(std::max(image.width - legend, image.width / 2));
    return {margin, margin, width - 2 * margin, static_cast<float>(image.height) - 2 * margin};
}

std::vector<Eigen::Vector3f> seen_points(const Scene& scene) {
    std::vector<Eigen::Vector3f> points;
    for (const Scene::Triangle& t : scene.triangles)
        for (std::uint32_t corner : t.corners) points.push_back(scene.points[corner]);
    return points;
}

std::size_t n_cells_met(const volmesh::TetMesh& mesh, const Plane& plane) {
    std::size_t n = 0;
    for (volmesh::CellHandle c : mesh.cells()) {
        int n_in_front = 0;
        for (const Eigen::Vector3d& p : mesh.cell_points(c))
            n_in_front += plane.signedDistance(p) > 0 ? 1 : 0;
        n += n_in_front > 0 && n_in_front < 4 ? 1 : 0;
    }
    return n;
}

}  // namespace

Plane front_cut(const volmesh::TetMesh& mesh, const Eigen::Vector3d& view) {
    Eigen::AlignedBox3d box;
    for (std::uint32_t i = 0; i < mesh.n_vertices(); ++i)
        if (!mesh.is_deleted(volmesh::VertexHandle(i))) box.extend(mesh.point(volmesh::VertexHandle(i)));
    const auto across = [&](int axis) {
        return Plane(Eigen::Vector3d::Unit(axis) * (view[axis] < 0 ? -1 : 1), box.center());
    };
    const int facing = std::abs(view.x()) > std::abs(view.y()) ? 0 : 1;
    const Plane first = across(facing);
    const Plane second = across(1 - facing);
    return n_cells_met(mesh, second) > n_cells_met(mesh, first) ? second : first;
}

void write_picture(const volmesh::TetMesh& mesh, const std::filesystem::path& path,
                   const PictureOptions& options) {
    check(options);
    const Scene scene =
        make_scene(mesh, options.cut ? *options.cut : std::vector{front_cut(mesh, options.view)});
    Image image(options.width, options.height);
    const int legend = options.legend ? legend_width(scene.legend, options.height) : 0;
    const Camera camera(options.view, seen_points(scene), frame_beside(legend, image));
    render(scene, camera, image);
    if (options.legend) draw_legend(scene.legend, image);
    write_png(image, path);
}

}  // namespace maille::picture
