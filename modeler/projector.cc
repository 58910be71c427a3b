#include <algorithm>
#include <memory>

#include <Eigen/Eigenvalues>

#include "modeler/model.hh"
#include "modeler/projector_newton.hh"
#include "modeler/trim.hh"

namespace maille::modeler {
namespace {

std::vector<std::shared_ptr<const Shape>> shapes_of(const Model& model) {
    std::vector<std::shared_ptr<const Shape>> shapes;
    for (const Primitive& primitive : model.primitives) shapes.push_back(primitive.shape);
    return shapes;
}

/// By number of the surface.
std::vector<ShapeFace> all_faces(const Model& model) {
    std::vector<ShapeFace> faces;
    for (const ModelSurface& surface : surfaces(model))
        faces.push_back({model.primitives[surface.primitive].shape.get(), surface.face});
    return faces;
}

std::optional<Point> project_to(std::span<const ShapeFace> faces, double size, const Point& p) {
    if (faces.empty()) return p;
    if (faces.size() == 1) return faces.front().shape->project(faces.front().face, p);
    return nearest_common_point(faces, p, size);
}

void add(std::vector<ShapeFace>& faces, const ShapeFace& face) {
    if (std::ranges::find(faces, face) == faces.end()) faces.push_back(face);
}

}  // namespace

SurfaceProjection surface_projection(const Model& model) {
    return [shapes = shapes_of(model), all = all_faces(model), size = diagonal(model)](
               std::span<const std::uint32_t> numbers, const Point& p) {
        std::vector<ShapeFace> faces;
        for (std::uint32_t number : numbers) add(faces, all[number]);
        return project_to(faces, size, p);
    };
}

volmesh::Projector projector(const Model& given) {
    const Model model = trimmed(given);
    volmesh::Projector result;
    for (const ModelSurface& surface : surfaces(model)) result.surfaces.push_back(surface.name);
    const auto count = static_cast<std::uint32_t>(result.surfaces.size());
    for (std::uint32_t i = 0; i < count; ++i)
        result.surfaces.push_back(result.surfaces[i] + std::string(inner_suffix));
    std::vector<std::uint32_t> numbers(result.surfaces.size());
    for (std::uint32_t i = 0; i < numbers.size(); ++i) numbers[i] = i % count;
    for (const Primitive& primitive : model.primitives)
        for (const auto& [number, name] : primitive.boundary_names) {
            result.surfaces.push_back(name);
            numbers.push_back(number);
        }
    result.model_size = diagonal(model);
    result.project = [project = surface_projection(model), numbers](std::span<const std::uint32_t> asked,
                                                                    const Point& p) {
        std::vector<std::uint32_t> surfaces;
        for (const std::uint32_t i : asked) surfaces.push_back(numbers[i]);
        return project(surfaces, p);
    };
    result.curvature = [faces = all_faces(model), shapes = shapes_of(model), numbers](std::uint32_t asked,
                                                                                      const Point& p) {
        const auto& [shape, face] = faces[numbers[asked]];
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(shape->face_curvature(face, p),
                                                                    Eigen::EigenvaluesOnly);
        return solver.eigenvalues().cwiseAbs().maxCoeff();
    };
    return result;
}

}  // namespace maille::modeler
