#include <algorithm>
#include <memory>

#include "modeler/model.hh"
#include "modeler/projector_newton.hh"

namespace maille::modeler {
namespace {

/// The faces of a model by the number of their surface. Holds the shapes.
struct Surfaces {
    std::vector<std::shared_ptr<const Shape>> shapes;
    std::vector<ShapeFace> faces;
};

std::shared_ptr<const Surfaces> collect_surfaces(const Model& model) {
    auto result = std::make_shared<Surfaces>();
    for (const Primitive& primitive : model.primitives) result->shapes.push_back(primitive.shape);
    for (const ModelSurface& surface : surfaces(model))
        result->faces.push_back({model.primitives[surface.primitive].shape.get(), surface.face});
    return result;
}

std::optional<Point> project_to(const Surfaces& all, double size, std::span<const std::uint32_t> numbers,
                                const Point& p) {
    std::vector<ShapeFace> faces;
    for (std::uint32_t number : numbers) {
        const ShapeFace& face = all.faces[number % all.faces.size()];
        if (std::ranges::find(faces, face) == faces.end()) faces.push_back(face);
    }
    if (faces.empty()) return p;
    if (faces.size() == 1) return faces.front().shape->project(faces.front().face, p);
    return nearest_common_point(faces, p, size);
}

}  // namespace

volmesh::Projector projector(const Model& model) {
    volmesh::Projector result;
    for (const ModelSurface& surface : surfaces(model)) result.surfaces.push_back(surface.name);
    const std::size_t count = result.surfaces.size();
    for (std::size_t i = 0; i < count; ++i)
        result.surfaces.push_back(result.surfaces[i] + std::string(inner_suffix));

    Eigen::AlignedBox3d box;
    for (const Primitive& primitive : model.primitives) box.extend(primitive.shape->bounding_box());
    result.model_size = box.isEmpty() ? 0 : box.diagonal().norm();
    result.project = [all = collect_surfaces(model), size = result.model_size](
                         std::span<const std::uint32_t> numbers, const Point& p) {
        return project_to(*all, size, numbers, p);
    };
    return result;
}

}  // namespace maille::modeler
