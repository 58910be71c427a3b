#include "modeler/arrange_classifier.hh"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "modeler/arrange_boxes.hh"
#include "modeler/arrange_ray.hh"
#include "modeler/arrange_scene.hh"

namespace maille::modeler {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangle = std::array<Kernel::Point_3, 3>;

Kernel::Point_3 to_kernel(const Eigen::Vector3d& p) {
    return {p.x(), p.y(), p.z()};
}

}  // namespace

struct SolidClassifier::Tree {
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> primitives;  ///< of the triangles
    detail::BoxTree boxes;
    double length;  ///< more than the diagonal

    /// Nothing where the ray meets an edge.
    std::optional<Containment> locate(const Eigen::Vector3d& point, int attempt) const;
};

std::optional<Containment> SolidClassifier::Tree::locate(const Eigen::Vector3d& point, int attempt) const {
    const Eigen::Vector3d far = point + length * detail::ray_direction(attempt);
    const auto p = to_kernel(point), q = to_kernel(far);
    std::vector<std::pair<std::uint32_t, int>> crossings;
    Containment result;
    const bool clear = boxes.visit(point, far, 1e-9 * length, [&](std::uint32_t t) {
        switch (detail::hit<Kernel>(p, q, triangles[t])) {
            case detail::Hit::miss:
                return true;
            case detail::Hit::leaving:
                crossings.emplace_back(primitives[t], 1);
                return true;
            case detail::Hit::entering:
                crossings.emplace_back(primitives[t], -1);
                return true;
            case detail::Hit::start:
                result.boundary.push_back(primitives[t]);
                return true;
            case detail::Hit::unclear:
                break;
        }
        return false;
    });
    if (!clear) return std::nullopt;
    std::ranges::sort(result.boundary);
    result.boundary.erase(std::unique(result.boundary.begin(), result.boundary.end()), result.boundary.end());
    std::ranges::sort(crossings);
    for (std::size_t i = 0; i < crossings.size();) {
        const auto primitive = crossings[i].first;
        int winding = 0;
        for (; i < crossings.size() && crossings[i].first == primitive; ++i) winding += crossings[i].second;
        if (winding > 0 && !std::ranges::binary_search(result.boundary, primitive))
            result.inside.push_back(primitive);
    }
    return result;
}

SolidClassifier::SolidClassifier(std::span<const ClosedSurface> primitives) {
    const FacetComplex complex = detail::gather(primitives).complex;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> owners;
    std::vector<Eigen::AlignedBox3d> boxes;
    for (std::uint32_t f = 0; f < complex.facets.size(); ++f) {
        const auto& [a, b, c] = complex.facets[f].vertices;
        Triangle t{to_kernel(complex.points[a]), to_kernel(complex.points[b]), to_kernel(complex.points[c])};
        if (CGAL::collinear(t[0], t[1], t[2])) continue;
        triangles.push_back(t);
        owners.push_back(static_cast<std::uint32_t>(complex.facets[f].back));
        boxes.push_back(detail::facet_box(complex, f));
    }
    const double length = 4 * detail::diagonal(complex);
    tree_ = std::make_unique<Tree>(std::move(triangles), std::move(owners), detail::BoxTree(boxes), length);
}

SolidClassifier::~SolidClassifier() = default;
SolidClassifier::SolidClassifier(SolidClassifier&&) noexcept = default;
SolidClassifier& SolidClassifier::operator=(SolidClassifier&&) noexcept = default;

Containment SolidClassifier::locate(const Eigen::Vector3d& point) const {
    if (!tree_->boxes.bounds().contains(point)) return {};
    for (int attempt = 0; attempt < detail::max_ray_attempts; ++attempt)
        if (auto found = tree_->locate(point, attempt)) return *found;
    throw std::logic_error("no ray in general position was found");
}

}  // namespace maille::modeler
