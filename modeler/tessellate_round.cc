#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "modeler/shape_frame.hh"
#include "modeler/tessellate_rows.hh"

namespace maille::modeler {
namespace {

int to_count(double wanted, int least) {
    return std::max(least, static_cast<int>(std::lround(wanted)));
}

struct Icosahedron {
    std::array<Point, 12> corners;
    std::vector<Triangle> faces;
};

/// One that is symmetric to the three coordinate planes.
Icosahedron make_icosahedron() {
    Icosahedron result;
    int next = 0;
    for (int axis = 0; axis < 3; ++axis)
        for (double a : {-1.0, 1.0})
            for (double b : {-std::numbers::phi, std::numbers::phi}) {
                Point& corner = result.corners[next++];
                corner[axis] = 0;
                corner[(axis + 1) % 3] = a;
                corner[(axis + 2) % 3] = b;
            }
    const auto adjacent = [&](std::uint32_t i, std::uint32_t j) {
        return (result.corners[i] - result.corners[j]).squaredNorm() < 4.1;
    };
    for (std::uint32_t i = 0; i < 12; ++i)
        for (std::uint32_t j = i + 1; j < 12; ++j)
            for (std::uint32_t k = j + 1; k < 12; ++k) {
                if (!adjacent(i, j) || !adjacent(j, k) || !adjacent(i, k)) continue;
                const auto& c = result.corners;
                const bool outward = c[i].cross(c[j]).dot(c[k]) > 0;
                result.faces.push_back(outward ? Triangle{i, j, k} : Triangle{i, k, j});
            }
    return result;
}

/// Mean length of the generators.
double slant_of(const Cone& cone) {
    double slant = 0;
    for (int i = 0; i < 8; ++i) {
        const Eigen::Vector2d u = unit_circle(i, 8) * (cone.radius(1) - cone.radius(0));
        slant += (cone.map().linear() * Point(u.x(), u.y(), 1)).norm() / 8;
    }
    return slant;
}

/// Heights of the rows of a band, from its lower to its upper end: closer where the rows are shorter of edge.
std::vector<double> row_heights(const Cone& cone, const Sizing& sizing, double low, double high) {
    constexpr int samples = 256;
    std::vector<double> wanted(samples);
    for (int i = 0; i < samples; ++i) {
        const double z = low + (high - low) * (i + 0.5) / samples;
        const Circumference row(cone.map(), sizing, cone.radius(z));
        wanted[i] = row.length() / row.edges() * std::numbers::sqrt3 / 2;
    }
    std::vector<double> heights = graded_places(wanted, slant_of(cone) * (high - low));
    for (double& height : heights) height = height < 1 ? low + (high - low) * height : high;
    return heights;
}

}  // namespace

SurfaceSeed seed_surface(const Ellipsoid& shape, const Sizing& sizing) {
    const Icosahedron icosahedron = make_icosahedron();
    const double radius = std::cbrt(shape.semi_axes().prod());
    // As many equilateral triangles as a sphere of that radius has room for.
    const double density = std::sqrt(4 * std::numbers::pi / (20 * std::numbers::sqrt3 / 4));
    // Fine enough for the sharpest bend too, so that no triangle of a flat one cuts through its rim.
    const double flatness = std::min(shape.semi_axes()[0] / shape.semi_axes()[2], 50.0);
    const double size = std::min(sizing.for_curvature(1 / radius), radius * std::numbers::pi / 4 / flatness);
    const int n = doubling_count(density * radius / size, 2);

    SurfaceSeed seed;
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> edge_points;
    const auto& c = icosahedron.corners;
    const auto place = [&](const Point& p) { return seed.add_point(shape.map() * p.normalized()); };
    for (const Point& corner : c) place(corner);
    // Point i of n - 1 from corner a to b.
    const auto on_edge = [&](std::uint32_t a, std::uint32_t b, int i) {
        const bool forward = a < b;
        const auto [entry, is_new] = edge_points.try_emplace({std::min(a, b), std::max(a, b)},
                                                             static_cast<std::uint32_t>(seed.points.size()));
        if (is_new)
            for (int k = 1; k < n; ++k) place((n - k) * c[entry->first[0]] + k * c[entry->first[1]]);
        return entry->second + static_cast<std::uint32_t>((forward ? i : n - i) - 1);
    };
    for (const Triangle& face : icosahedron.faces) {
        // Row i holds i + 1 points, from the edge 0-1 to the edge 0-2.
        std::vector<std::vector<std::uint32_t>> rows(n + 1);
        for (int i = 0; i <= n; ++i)
            for (int j = 0; j <= i; ++j) {
                std::uint32_t vertex = 0;
                if (i == 0)
                    vertex = face[0];
                else if (i == n)
                    vertex = j == 0 ? face[1] : j == n ? face[2] : on_edge(face[1], face[2], j);
                else if (j == 0)
                    vertex = on_edge(face[0], face[1], i);
                else if (j == i)
                    vertex = on_edge(face[0], face[2], i);
                else
                    vertex = place((n - i) * c[face[0]] + (i - j) * c[face[1]] + j * c[face[2]]);
                rows[i].push_back(vertex);
            }
        const bool mirrored = is_mirror(shape.map());
        for (int i = 0; i < n; ++i)
            for (int j = 0; j <= i; ++j) {
                seed.add_triangle({rows[i][j], rows[i + 1][j], rows[i + 1][j + 1]}, 0, mirrored);
                if (j < i) seed.add_triangle({rows[i][j], rows[i + 1][j + 1], rows[i][j + 1]}, 0, mirrored);
            }
    }
    return seed;
}

SurfaceSeed seed_surface(const Torus& shape, const Sizing& sizing) {
    const double scale = std::cbrt(std::abs(shape.map().linear().determinant()));
    const double minor = scale * shape.minor(), major = scale * shape.major();
    const double size = sizing.for_curvature(1 / minor);
    // Every other row is half a step on, so that the number of rows is even.
    const int rows = 2 * doubling_count(std::numbers::pi * minor / (size * std::numbers::sqrt3 / 2), 4);
    const int count = 4 * doubling_count(std::numbers::pi * major / (2 * size), 2);
    SurfaceSeed seed;
    std::vector<Row> row;
    for (int j = 0; j < rows; ++j) {
        row.push_back({static_cast<std::uint32_t>(seed.points.size()), count, j % 2});
        const Eigen::Vector2d v = shape.minor() * unit_circle(j, rows);
        for (int i = 0; i < count; ++i) {
            const Eigen::Vector2d u = unit_circle(2 * i + j % 2, 2 * count) * (shape.major() + v.x());
            seed.add_point(shape.map() * Point(u.x(), u.y(), v.y()));
        }
    }
    for (int j = 0; j < rows; ++j) stitch(seed, row[j], row[(j + 1) % rows], 0, is_mirror(shape.map()));
    return seed;
}

int rim_count(const Cone& cone, const Sizing& sizing, bool end) {
    return rim_count(Circumference(cone.map(), sizing, cone.radius(end)), slant_of(cone));
}

SurfaceSeed seed_surface(const Cone& shape, const Sizing& sizing) {
    const auto count = [&](bool end) { return shape.cap(end) ? rim_count(shape, sizing, end) : 0; };
    return seed_shared_surface(shape, sizing,
                               {.reference = shape, .rims = {{0, count(false)}, {1, count(true)}}});
}

SurfaceSeed seed_shared_surface(const Cone& shape, const Sizing& sizing, const SharedCone& shared) {
    const Cone& cone = shared.reference;
    const Circumference widest(cone.map(), sizing, 1);
    const bool is_cylinder = cone.radius(0) == cone.radius(1);
    const bool mirrored = is_mirror(cone.map());
    const auto place = [&](const Eigen::Vector2d& xy, double z) {
        const double radius = cone.radius(z);
        return Point(cone.map() * Point(radius * xy.x(), radius * xy.y(), z));
    };
    const auto nearest_rim = [&, inverse = cone.map().inverse()](double own_height) {
        const double z = (inverse * (shape.map() * Point(0, 0, own_height))).z();
        return std::ranges::min_element(shared.rims, {}, [&](auto& rim) { return std::abs(rim.height - z); });
    };
    const auto [first, last] = std::minmax({nearest_rim(0), nearest_rim(1)});
    const bool is_upside_down = nearest_rim(0) == last;

    SurfaceSeed seed;
    Row previous;
    const auto add_row = [&](double z, int count, int offset) {
        const bool is_bottom = z == first->height, is_top = z == last->height;
        Row row{.first = static_cast<std::uint32_t>(seed.points.size()), .count = 1, .offset = 0};
        if (count > 0) {
            row.count = count;
            row.offset = offset;
            const auto cap = is_bottom || is_top ? shape.cap(is_top != is_upside_down) : std::nullopt;
            std::vector<std::uint32_t> loop;
            for (int i = 0; i < count; ++i) {
                const Point p = place(widest.direction(2 * i + offset, 2 * count), z);
                loop.push_back(seed.add_point(cap ? shape.project(*cap, p) : p));
            }
            if (is_bottom != mirrored) std::ranges::reverse(loop);
            if (cap) {
                const Point centre = place(Eigen::Vector2d::Zero(), z);
                fill_planar_face(seed, Plane(centre, shape.face_normal(*cap, centre)), {loop}, *cap,
                                 sizing.size());
            }
        } else {
            seed.corners.push_back(seed.add_point(place(Eigen::Vector2d::Zero(), z)));
        }
        if (!is_bottom) stitch(seed, previous, row, 0, mirrored);
        previous = row;
    };
    add_row(first->height, first->count, 0);
    for (auto low = first; low != last; ++low) {
        const auto high = std::next(low);
        const std::vector<double> heights = row_heights(cone, sizing, low->height, high->height);
        for (std::size_t k = 1; k + 1 < heights.size(); ++k) {
            const Circumference row(cone.map(), sizing, cone.radius(heights[k]));
            const int wanted = is_cylinder ? first->count : to_count(row.edges(), 6);
            const auto [count, offset] = row_between(low->count, high->count, k, heights.size() - 1, wanted);
            add_row(heights[k], count, shared.is_straight ? 0 : offset);
        }
        add_row(high->height, high->count, 0);
    }
    return seed;
}

SurfaceSeed seed_shared_surface(const Ellipsoid& sphere, const SharedSphere& shared) {
    const int n = shared.count / 4;
    const double radius = sphere.semi_axes()[0];
    SurfaceSeed seed;
    std::map<std::array<int, 3>, std::uint32_t> known;
    // The point of the sphere with these parts of n, which are evenly spaced along the great circles.
    const auto point_at = [&](const std::array<int, 3>& parts) {
        const auto [entry, is_new] = known.try_emplace(parts, static_cast<std::uint32_t>(seed.points.size()));
        if (is_new) {
            Point p;
            for (int k = 0; k < 3; ++k) p[k] = unit_circle(parts[k], 4 * n).y();
            seed.add_point(sphere.map().translation() + radius * (shared.axes * p.normalized()));
        }
        return entry->second;
    };
    const bool is_left_handed = shared.axes.determinant() < 0;
    for (const int x : {1, -1})
        for (const int y : {1, -1})
            for (const int z : {1, -1}) {
                const auto at = [&](int i, int j) { return point_at({x * i, y * j, z * (n - i - j)}); };
                const bool mirrored = (x * y * z < 0) != is_left_handed;
                for (int i = 0; i < n; ++i)
                    for (int j = 0; i + j < n; ++j) {
                        seed.add_triangle({at(i, j), at(i + 1, j), at(i, j + 1)}, 0, mirrored);
                        if (i + j + 1 < n)
                            seed.add_triangle({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}, 0, mirrored);
                    }
            }
    return seed;
}

}  // namespace maille::modeler
