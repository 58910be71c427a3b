#include "modeler/build_points.hh"

#include <algorithm>
#include <map>

#include "modeler/build_primitives.hh"
#include "volmesh/face_surfaces.hh"

namespace maille::modeler {
namespace {

using volmesh::VertexHandle;

/// The surfaces of the vertices that are short of them.
std::map<VertexHandle, volmesh::Surfaces> supports_of(
    const Merged& merged, std::span<const quality::ShortOfTarget> short_of_target) {
    std::map<VertexHandle, volmesh::Surfaces> supports;
    for (const quality::ShortOfTarget& left : short_of_target) supports[left.vertex];
    for (const InterfaceFace& face : merged.faces)
        for (const VertexHandle v : merged.mesh.halfface_vertices(face.face))
            if (const auto found = supports.find(v); found != supports.end())
                volmesh::add(found->second, {face.surface});
    return supports;
}

class Collector {
  public:
    explicit Collector(const Model& model)
        : model_(model),
          numbered_(surfaces(model)),
          project_(surface_projection(model)),
          size_(diagonal(model)),
          points_(model.primitives.size()) {}

    void add(const volmesh::Surfaces& surfaces, const Point& p) {
        const auto common = project_({surfaces.data(), surfaces.size()}, p);
        if (common && (*common - p).norm() < reach * size_) add(*common);
        for (const std::uint32_t s : surfaces)
            add(model_.primitives[numbered_[s].primitive].shape->project(numbered_[s].face, p));
    }

    std::vector<std::vector<FacePoint>> take() { return std::move(points_); }

  private:
    static constexpr double reach = 0.1, same_place = 1e-9;  // to the model's size

    /// To all round faces that go through the point.
    void add(const Point& p) {
        for (std::uint32_t i = 0; i < points_.size(); ++i) {
            const Shape& shape = *model_.primitives[i].shape;
            if (shape.bounding_box().exteriorDistance(p) > same_place * size_) continue;
            for (std::uint32_t face = 0; face < shape.faces().size(); ++face)
                if (!shape.faces()[face].planar && (shape.project(face, p) - p).norm() <= same_place * size_)
                    points_[i].push_back({face, p});
        }
    }

    const Model& model_;
    std::vector<ModelSurface> numbered_;
    SurfaceProjection project_;
    double size_;
    std::vector<std::vector<FacePoint>> points_;
};

}  // namespace

std::vector<std::vector<FacePoint>> points_to_meet(const Model& model, const Merged& merged,
                                                   std::span<const quality::ShortOfTarget> short_of_target) {
    Collector collector(model);
    for (const auto& [vertex, surfaces] : supports_of(merged, short_of_target))
        collector.add(surfaces, merged.mesh.point(vertex));
    return collector.take();
}

}  // namespace maille::modeler
