#include "quality/size_limit.hh"

#include <algorithm>
#include <cmath>

#include "volmesh/tet_topology.hh"

namespace maille::quality {

double SizeLimit::excess(const std::array<Point, 4>& cell) const {
    if (!size_) return 1;
    const Point centroid = (cell[0] + cell[1] + cell[2] + cell[3]) / 4;
    double longest = 0;
    for (const auto& [i, j] : volmesh::tet::edge_vertices)
        longest = std::max(longest, (cell[i] - cell[j]).squaredNorm());
    return std::max(1.0, std::sqrt(longest) / (ratio_ * (*size_)(centroid)));
}

bool SizeLimit::keeps(const Bases& bases, const Point& from, const Point& to) const {
    if (!size_) return true;
    const auto excess_with = [&](const Point& p) {
        double worst = 1;
        for (const Base& base : bases) worst = std::max(worst, excess({p, base[0], base[1], base[2]}));
        return worst;
    };
    const double after = excess_with(to);
    return after <= 1 || after <= excess_with(from);
}

}  // namespace maille::quality
