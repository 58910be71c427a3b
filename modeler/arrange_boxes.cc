#include "modeler/arrange_boxes.hh"

#include <algorithm>

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

namespace maille::modeler::detail {

Eigen::AlignedBox3d facet_box(const FacetComplex& complex, std::uint32_t facet) {
    Eigen::AlignedBox3d box;
    for (const auto v : complex.facets[facet].vertices) box.extend(complex.points[v]);
    return box;
}

std::vector<Pair> pairs_of_near_facets(const FacetComplex& complex, double margin,
                                       const std::function<bool(std::uint32_t, std::uint32_t)>& wanted) {
    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t,
                                                          CGAL::Box_intersection_d::ID_EXPLICIT>;
    std::vector<Box> boxes;
    boxes.reserve(complex.facets.size());
    for (std::uint32_t i = 0; i < complex.facets.size(); ++i) {
        const Eigen::AlignedBox3d b = facet_box(complex, i);
        boxes.emplace_back(CGAL::Bbox_3(b.min().x() - margin, b.min().y() - margin, b.min().z() - margin,
                                        b.max().x() + margin, b.max().y() + margin, b.max().z() + margin),
                           i);
    }
    std::vector<Pair> pairs;
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
        const auto [i, j] = std::minmax({a.info(), b.info()});
        if (wanted(i, j)) pairs.emplace_back(i, j);
    });
    std::ranges::sort(pairs);
    return pairs;
}

}  // namespace maille::modeler::detail
