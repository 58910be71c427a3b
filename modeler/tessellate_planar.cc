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

namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;  // the lower number first

Edge edge_of(const std::vector<std::uint32_t>& loop, std::size_t k) {
    return std::minmax({loop[k], loop[(k + 1) % loop.size()]});
}

/// Where the edges of a polyhedron are cut: places from the end of lower number, by the size and by how near
/// other edges of the same face run.
class EdgeCuts {
  public:
    EdgeCuts(const Polyhedron& shape, double size) : shape_(shape), size_(size) {
        for (std::uint32_t face = 0; face < shape.faces().size(); ++face) {
            std::vector<Edge> edges;
            for (const auto& loop : shape.polygon(face).loops)
                for (std::size_t k = 0; k < loop.size(); ++k) edges.push_back(edge_of(loop, k));
            for (const Edge& edge : edges) limit(edge, edges);
        }
    }

    std::vector<double> places(const Edge& edge) const {
        return graded_places(wanted_.at(edge), length(edge));
    }

  private:
    static constexpr int parts = 32;

    double length(const Edge& edge) const {
        return (shape_.points()[edge.second] - shape_.points()[edge.first]).norm();
    }

    void limit(const Edge& edge, const std::vector<Edge>& others) {
        // Finer than that the mesh does not get where it is thin.
        const double least = std::min(size_, length(edge)) / 8;
        std::vector<double>& wanted = wanted_.try_emplace(edge, parts, size_).first->second;
        const Point from = shape_.points()[edge.first], to = shape_.points()[edge.second];
        for (const auto& [c, d] : others) {
            if (c == edge.first || c == edge.second || d == edge.first || d == edge.second) continue;
            const Point start = shape_.points()[c], way = shape_.points()[d] - start;
            for (int i = 0; i < parts; ++i) {
                const Point p = from + (i + 0.5) / parts * (to - from);
                const double t = std::clamp((p - start).dot(way) / way.squaredNorm(), 0.0, 1.0);
                wanted[i] = std::min(wanted[i], std::max(least, (start + t * way - p).norm()));
            }
        }
    }

    const Polyhedron& shape_;
    double size_;
    std::map<Edge, std::vector<double>> wanted_;
};

}  // namespace

SurfaceSeed seed_surface(const Polyhedron& shape, const Sizing& sizing) {
    SurfaceSeed seed;
    seed.points.assign(shape.points().begin(), shape.points().end());
    for (std::uint32_t i = 0; i < seed.points.size(); ++i) seed.corners.push_back(i);

    const EdgeCuts cuts(shape, sizing.size());
    std::map<Edge, std::vector<std::uint32_t>> chains;  // the points within each edge
    const auto chain_of = [&](const Edge& edge) -> const std::vector<std::uint32_t>& {
        const auto [entry, is_new] = chains.try_emplace(edge);
        if (is_new) {
            const Point from = seed.points[edge.first], to = seed.points[edge.second];
            const std::vector<double> places = cuts.places(edge);
            for (std::size_t k = 1; k + 1 < places.size(); ++k)
                entry->second.push_back(seed.add_point(from + places[k] * (to - from)));
        }
        return entry->second;
    };
    for (std::uint32_t face = 0; face < shape.faces().size(); ++face) {
        Loops loops;
        for (const auto& corners : shape.polygon(face).loops) {
            std::vector<std::uint32_t>& loop = loops.emplace_back();
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const Edge edge = edge_of(corners, k);
                const auto& chain = chain_of(edge);
                loop.push_back(corners[k]);
                if (edge.first == corners[k])
                    loop.insert(loop.end(), chain.begin(), chain.end());
                else
                    loop.insert(loop.end(), chain.rbegin(), chain.rend());
            }
        }
        fill_planar_face(seed, shape.plane(face), loops, face, sizing.size());
    }
    return seed;
}

}  // namespace maille::modeler
