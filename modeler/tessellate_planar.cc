#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "modeler/tessellate_seed.hh"

namespace maille::modeler {
namespace {

using Eigen::Vector2d;
using Loops = std::vector<std::vector<std::uint32_t>>;

double distance_to_segment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
    const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (a + t * (b - a) - p).norm();
}

/// A lattice of equilateral triangles over a box; one of its points is the middle of the box.
class Lattice {
  public:
    Lattice(const Eigen::AlignedBox2d& box, double spacing)
        : spacing_(spacing), height_(spacing * std::numbers::sqrt3 / 2) {
        half_rows_ = static_cast<int>(std::ceil(box.sizes().y() / 2 / height_)) + 1;
        half_columns_ = static_cast<int>(std::ceil(box.sizes().x() / 2 / spacing_)) + 1;
        centre_ = box.center();
    }

    int rows() const { return 2 * half_rows_ + 1; }
    int columns() const { return 2 * half_columns_ + 1; }
    double y(int row) const { return centre_.y() + (row - half_rows_) * height_; }
    Vector2d at(int row, int column) const {
        const double shift = (row - half_rows_) % 2 != 0 ? 0.5 : 0;
        return {centre_.x() + (column - half_columns_ + shift) * spacing_, y(row)};
    }
    int row_below(double y) const { return static_cast<int>(std::floor((y - this->y(0)) / height_)); }
    int column_before(double x) const {
        return static_cast<int>(std::floor((x - centre_.x()) / spacing_)) + half_columns_;
    }

  private:
    double spacing_, height_;
    int half_rows_, half_columns_;
    Vector2d centre_;
};

/// The lattice points in the region that keep their distance from its boundary.
std::vector<Vector2d> interior_points(std::span<const Vector2d> boundary, const Loops& loops,
                                      double spacing) {
    Eigen::AlignedBox2d box;
    for (const Vector2d& p : boundary) box.extend(p);
    const Lattice lattice(box, spacing);
    const double clearance = 0.65 * spacing;
    const int rows = lattice.rows(), columns = lattice.columns();
    std::vector<bool> too_close(static_cast<std::size_t>(rows) * columns, false);
    std::vector<std::vector<double>> crossings(rows);
    for (const auto& loop : loops)
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const Vector2d a = boundary[loop[k]], b = boundary[loop[(k + 1) % loop.size()]];
            const auto [low_y, high_y] = std::minmax(a.y(), b.y());
            const auto [low_x, high_x] = std::minmax(a.x(), b.x());
            for (int row = std::max(0, lattice.row_below(low_y - clearance));
                 row <= std::min(rows - 1, lattice.row_below(high_y + clearance) + 1); ++row) {
                const double y = lattice.y(row);
                if ((a.y() <= y) != (b.y() <= y))
                    crossings[row].push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
                for (int column = std::max(0, lattice.column_before(low_x - clearance) - 1);
                     column <= std::min(columns - 1, lattice.column_before(high_x + clearance) + 1); ++column)
                    if (distance_to_segment(lattice.at(row, column), a, b) < clearance)
                        too_close[static_cast<std::size_t>(row) * columns + column] = true;
            }
        }
    std::vector<Vector2d> points;
    for (int row = 0; row < rows; ++row) {
        std::ranges::sort(crossings[row]);
        std::size_t crossed = 0;
        for (int column = 0; column < columns; ++column) {
            const Vector2d p = lattice.at(row, column);
            while (crossed < crossings[row].size() && crossings[row][crossed] < p.x()) ++crossed;
            if (crossed % 2 == 1 && !too_close[static_cast<std::size_t>(row) * columns + column])
                points.push_back(p);
        }
    }
    return points;
}

}  // namespace

void fill_planar_face(SurfaceSeed& seed, const Plane& plane, const Loops& loops, std::uint32_t surface,
                      double size) {
    std::vector<std::uint32_t> vertices;
    std::vector<Vector2d> flat;
    Loops local(loops.size());
    double longest = 0;
    for (std::size_t i = 0; i < loops.size(); ++i)
        for (std::size_t k = 0; k < loops[i].size(); ++k) {
            local[i].push_back(static_cast<std::uint32_t>(vertices.size()));
            vertices.push_back(loops[i][k]);
            flat.push_back(plane.flatten(seed.points[loops[i][k]]));
            const std::uint32_t next = loops[i][(k + 1) % loops[i].size()];
            longest = std::max(longest, (seed.points[next] - seed.points[loops[i][k]]).norm());
        }
    for (const Vector2d& p : interior_points(flat, local, std::min(size, longest))) {
        flat.push_back(p);
        vertices.push_back(seed.add_point(plane.unflatten(p)));
    }
    for (const auto& [a, b, c] : triangulate(flat, local))
        seed.add_triangle({vertices[a], vertices[b], vertices[c]}, surface);
}

SurfaceSeed seed_surface(const Polyhedron& shape, const Sizing& sizing) {
    SurfaceSeed seed;
    seed.points.assign(shape.points().begin(), shape.points().end());
    for (std::uint32_t i = 0; i < seed.points.size(); ++i) seed.corners.push_back(i);

    // The first of the points within each edge, which runs from the end of lower number.
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::uint32_t, std::uint32_t>> inner;
    const auto divide = [&](std::uint32_t a, std::uint32_t b, std::vector<std::uint32_t>& loop) {
        const auto [low, high] = std::minmax(a, b);
        const auto [entry, is_new] =
            inner.try_emplace({low, high}, static_cast<std::uint32_t>(seed.points.size()), 0u);
        auto& [first, count] = entry->second;
        if (is_new) {
            const Point from = seed.points[low], to = seed.points[high];
            const double pieces = std::max(1.0, std::round((to - from).norm() / sizing.size()));
            count = static_cast<std::uint32_t>(pieces) - 1;
            for (std::uint32_t k = 1; k <= count; ++k) seed.add_point(from + k / pieces * (to - from));
        }
        loop.push_back(a);
        for (std::uint32_t k = 0; k < count; ++k) loop.push_back(first + (a < b ? k : count - 1 - k));
    };
    for (std::uint32_t face = 0; face < shape.faces().size(); ++face) {
        Loops loops;
        for (const auto& corners : shape.polygon(face).loops) {
            loops.emplace_back();
            for (std::size_t k = 0; k < corners.size(); ++k)
                divide(corners[k], corners[(k + 1) % corners.size()], loops.back());
        }
        fill_planar_face(seed, shape.plane(face), loops, face, sizing.size());
    }
    return seed;
}

}  // namespace maille::modeler
