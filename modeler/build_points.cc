#include "modeler/build_points.hh"

#include <algorithm>
#include <map>

#include "modeler/build_primitives.hh"
#include "modeler/point_grid.hh"
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

/// Points no further apart are one; to the model's size.
constexpr double same_place = 1e-9;

/// The vertices that the surfaces have or are to get. What is nearly at one of them is moved there: two that
/// close, on surfaces that cross there, would leave facets too small to be meshed.
class Places {
  public:
    Places(std::span<const Operand> operands, double model_size)
        : same_(same_place * model_size),
          near_(close * std::ranges::min_element(operands, {}, &Operand::size)->size) {
        for (const Operand& operand : operands)
            for (const Point& p : operand.surface.points) add(p);
    }

    /// The one at p or, if there is none, the one near to it, or else p itself, which is one from now on.
    Point at(const Point& p) {
        if (const auto same = same_.find(p)) return points_[*same];
        if (const auto near = near_.find(p)) return points_[*near];
        add(p);
        return p;
    }

  private:
    static constexpr double close = 1e-3;  // to the edges' size

    void add(const Point& p) {
        const auto number = static_cast<std::uint32_t>(points_.size());
        for (PointGrid* grid : {&same_, &near_}) grid->add(p, number);
        points_.push_back(p);
    }

    std::vector<Point> points_;
    PointGrid same_, near_;
};

class Collector {
  public:
    Collector(const Model& model, std::span<const Operand> operands)
        : model_(model),
          numbered_(surfaces(model)),
          project_(surface_projection(model)),
          size_(diagonal(model)),
          places_(operands, size_),
          points_(model.primitives.size()) {}

    void add(const volmesh::Surfaces& surfaces, const Point& p) {
        const auto common = project_({surfaces.data(), surfaces.size()}, p);
        if (common && (*common - p).norm() < reach * size_) add(*common);
        for (const std::uint32_t s : surfaces)
            add(model_.primitives[numbered_[s].primitive].shape->project(numbered_[s].face, p));
    }

    std::vector<std::vector<FacePoint>> take() { return std::move(points_); }

  private:
    static constexpr double reach = 0.1;  // to the model's size

    /// To all round faces that go through the point.
    void add(const Point& wanted) {
        const Point p = places_.at(wanted);
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
    Places places_;
    std::vector<std::vector<FacePoint>> points_;
};

}  // namespace

std::vector<std::vector<FacePoint>> points_to_meet(const Model& model, std::span<const Operand> operands,
                                                   const Merged& merged,
                                                   std::span<const quality::ShortOfTarget> short_of_target) {
    Collector collector(model, operands);
    for (const auto& [vertex, surfaces] : supports_of(merged, short_of_target))
        collector.add(surfaces, merged.mesh.point(vertex));
    return collector.take();
}

}  // namespace maille::modeler
