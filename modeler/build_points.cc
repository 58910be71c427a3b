#include "modeler/build_points.hh"

#include <algorithm>
#include <map>
#include <set>

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

double smallest_size(std::span<const Operand> operands) {
    return std::ranges::min_element(operands, {}, &Operand::size)->size;
}

/// The vertices that the surfaces have or are to get. What is nearly at one of them is moved there: two that
/// close, on surfaces that cross there, would leave facets too small to be meshed.
class Places {
  public:
    Places(std::span<const Operand> operands, double model_size)
        : same_(same_place * model_size), near_(close * smallest_size(operands)) {
        for (const Operand& operand : operands)
            for (const Point& p : operand.surface.points) add(p);
    }

    /// The number of the one at p or, if there is none, of the one near to it, or else of p itself, which is
    /// one from now on.
    std::uint32_t number_at(const Point& p) {
        if (const auto same = same_.find(p)) return *same;
        if (const auto near = near_.find(p)) return *near;
        add(p);
        return static_cast<std::uint32_t>(points_.size() - 1);
    }
    const Point& operator[](std::uint32_t number) const { return points_[number]; }

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
          slack_(on_surface * smallest_size(operands)),
          places_(operands, size_),
          result_{0, std::vector<std::vector<FacePoint>>(model.primitives.size())} {}

    void add(const volmesh::Surfaces& surfaces, const Point& p) {
        std::vector<Point> nearest;
        for (const std::uint32_t s : surfaces)
            nearest.push_back(model_.primitives[numbered_[s].primitive].shape->project(numbered_[s].face, p));
        if (std::ranges::all_of(nearest, [&](const Point& q) { return (q - p).norm() <= slack_; })) return;
        ++result_.n_vertices;
        const auto common = project_({surfaces.data(), surfaces.size()}, p);
        if (common && (*common - p).norm() < reach * size_) add(*common);
        for (const Point& q : nearest) add(q);
    }

    PointsToMeet take() { return std::move(result_); }

  private:
    static constexpr double reach = 0.1;  // to the model's size

    /// To all round faces that go through the point, as far as rounded coordinates of the model can tell.
    void add(const Point& wanted) {
        const std::uint32_t number = places_.number_at(wanted);
        if (!taken_.insert(number).second) return;
        const Point& p = places_[number];
        for (std::uint32_t i = 0; i < result_.points.size(); ++i) {
            const Shape& shape = *model_.primitives[i].shape;
            if (shape.bounding_box().exteriorDistance(p) > slack_) continue;
            for (std::uint32_t face = 0; face < shape.faces().size(); ++face)
                if (!shape.faces()[face].planar && (shape.project(face, p) - p).norm() <= slack_)
                    result_.points[i].push_back({face, p});
        }
    }

    const Model& model_;
    std::vector<ModelSurface> numbered_;
    SurfaceProjection project_;
    double size_, slack_;
    Places places_;
    std::set<std::uint32_t> taken_;
    PointsToMeet result_;
};

}  // namespace

PointsToMeet points_to_meet(const Model& model, std::span<const Operand> operands, const Merged& merged,
                            std::span<const quality::ShortOfTarget> short_of_target) {
    Collector collector(model, operands);
    for (const auto& [vertex, surfaces] : supports_of(merged, short_of_target))
        collector.add(surfaces, merged.mesh.point(vertex));
    return collector.take();
}

}  // namespace maille::modeler
