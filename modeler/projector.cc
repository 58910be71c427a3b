#include <algorithm>
#include <map>
#include <memory>

#include "modeler/model.hh"
#include "modeler/projector_newton.hh"

namespace maille::modeler {
namespace {

/// The faces that share a surface's name, for each name in order of appearance. Holds the shapes.
struct NamedSurfaces {
    std::vector<std::shared_ptr<const Shape>> shapes;
    std::vector<std::string> names;
    std::vector<std::vector<ShapeFace>> faces;
    double model_size = 0;
};

std::vector<std::shared_ptr<const Shape>> shapes_of(const Model& model) {
    std::vector<std::shared_ptr<const Shape>> shapes;
    for (const Primitive& primitive : model.primitives) shapes.push_back(primitive.shape);
    return shapes;
}

double size_of(const Model& model) {
    Eigen::AlignedBox3d box;
    for (const Primitive& primitive : model.primitives) box.extend(primitive.shape->bounding_box());
    return box.isEmpty() ? 0 : box.diagonal().norm();
}

std::shared_ptr<const NamedSurfaces> collect_by_name(const Model& model) {
    auto result = std::make_shared<NamedSurfaces>();
    result->shapes = shapes_of(model);
    result->model_size = size_of(model);
    std::map<std::string, std::size_t> places;
    for (const ModelSurface& surface : surfaces(model)) {
        const auto [place, is_new] = places.try_emplace(surface.name, result->names.size());
        if (is_new) {
            result->names.push_back(surface.name);
            result->faces.emplace_back();
        }
        result->faces[place->second].push_back(
            {model.primitives[surface.primitive].shape.get(), surface.face});
    }
    return result;
}

const ShapeFace& nearest(std::span<const ShapeFace> faces, const Point& p) {
    if (faces.size() == 1) return faces.front();
    return *std::ranges::min_element(faces, {}, [&](const ShapeFace& face) {
        return (face.shape->project(face.face, p) - p).squaredNorm();
    });
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
    std::vector<ShapeFace> all;
    for (const ModelSurface& surface : surfaces(model))
        all.push_back({model.primitives[surface.primitive].shape.get(), surface.face});
    return [shapes = shapes_of(model), all = std::move(all), size = size_of(model)](
               std::span<const std::uint32_t> numbers, const Point& p) {
        std::vector<ShapeFace> faces;
        for (std::uint32_t number : numbers) add(faces, all[number]);
        return project_to(faces, size, p);
    };
}

volmesh::Projector projector(const Model& model) {
    const auto named = collect_by_name(model);
    volmesh::Projector result;
    result.surfaces = named->names;
    for (const std::string& name : named->names) result.surfaces.push_back(name + std::string(inner_suffix));
    result.model_size = named->model_size;
    result.project = [named](std::span<const std::uint32_t> numbers, const Point& p) {
        std::vector<ShapeFace> faces;
        for (std::uint32_t number : numbers)
            add(faces, nearest(named->faces[number % named->faces.size()], p));
        return project_to(faces, named->model_size, p);
    };
    return result;
}

}  // namespace maille::modeler
