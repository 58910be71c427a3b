#include "modeler/build_size.hh"

#include <algorithm>
#include <cmath>

namespace maille::modeler {
namespace {

/// How fast edges may grow away from a fine surface.
constexpr double growth = 0.5;

struct EdgeLengths {
    double sum = 0;
    int count = 0;
    double mean() const { return sum / count; }
};

/// By surface number.
std::vector<EdgeLengths> edge_lengths(std::span<const ClosedSurface> tessellated, std::size_t n_surfaces) {
    std::vector<EdgeLengths> lengths(n_surfaces);
    for (const ClosedSurface& surface : tessellated)
        for (std::size_t t = 0; t < surface.triangles.size(); ++t)
            for (int k = 0; k < 3; ++k) {
                const auto& v = surface.triangles[t];
                EdgeLengths& of_surface = lengths[surface.surfaces[t]];
                of_surface.sum += (surface.points[v[k]] - surface.points[v[(k + 1) % 3]]).norm();
                ++of_surface.count;
            }
    return lengths;
}

}  // namespace

SurfaceSize::SurfaceSize(const Model& model, std::vector<double> sizes,
                         std::span<const ClosedSurface> tessellated)
    : sizes_(std::move(sizes)), largest_(std::ranges::max(sizes_)) {
    std::vector<Eigen::AlignedBox3d> reaches;  // where surfaces may matter
    const std::vector<ModelSurface> numbered = surfaces(model);
    const std::vector<EdgeLengths> lengths = edge_lengths(tessellated, numbered.size());
    for (std::size_t s = 0; s < numbered.size(); ++s) {
        const Primitive& primitive = model.primitives[numbered[s].primitive];
        if (primitive.shape->faces()[numbered[s].face].planar || lengths[s].count == 0) continue;
        const double size = lengths[s].mean();
        if (size > 0.8 * largest_) continue;
        const Eigen::AlignedBox3d box = primitive.shape->bounding_box();
        const double margin = (largest_ - size) / growth;
        reaches.emplace_back(box.min().array() - margin, box.max().array() + margin);
        fine_.push_back({primitive.shape, numbered[s].face, size, box});
    }
    reaches_ = std::make_shared<const detail::BoxTree>(reaches);
}

double SurfaceSize::operator()(const Eigen::Vector3d& p, Region front, Region back) const {
    double size = largest_;
    for (const Region region : {front, back})
        if (region >= 0) size = std::min(size, sizes_[region]);
    reaches_->visit_box({p, p}, [&](std::uint32_t i) {
        const FineSurface& fine = fine_[i];
        const double beyond = fine.box.exteriorDistance(p);
        if (size <= fine.size + growth * beyond) return true;
        const double distance = std::abs(fine.shape->face_implicit(fine.face, p));
        size = std::min(size, fine.size + growth * std::max(distance, beyond));
        return true;
    });
    return size;
}

}  // namespace maille::modeler
