#include <cmath>
#include <iterator>
#include <limits>

#include <Eigen/Geometry>
#include <boost/geometry/core/cs.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <fmt/format.h>

#include "refine/size_field.hh"
#include "volmesh/error.hh"

namespace maille::refine {
namespace {

using volmesh::TetMesh;
using Corners = std::array<Point, 4>;
using Weights = Eigen::Vector4d;

namespace bgi = boost::geometry::index;
using TreePoint = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
using TreeBox = boost::geometry::model::box<TreePoint>;
using TreeEntry = std::pair<TreeBox, std::uint32_t>;
using Tree = bgi::rtree<TreeEntry, bgi::rstar<8>>;

TreePoint tree_point(const Point& p) {
    return {p.x(), p.y(), p.z()};
}

/// Barycentric coordinates of p; where the cell is flat, those of a point that is outside.
Weights barycentric(const Corners& t, const Point& p) {
    const auto det = [](const Point& a, const Point& b, const Point& c) { return a.cross(b).dot(c); };
    const Point b = t[1] - t[0], c = t[2] - t[0], d = t[3] - t[0], q = p - t[0];
    const double whole = det(b, c, d);
    if (whole == 0) return Weights::Constant(-1);
    const double wb = det(q, c, d) / whole, wc = det(b, q, d) / whole, wd = det(b, c, q) / whole;
    return {1 - wb - wc - wd, wb, wc, wd};
}

/// Barycentric coordinates of the point of the triangle abc nearest to p, by the region that p lies in.
/// (C. Ericson, "Real-Time Collision Detection", 5.1.5.)
Eigen::Vector3d nearest_on_triangle(const Point& a, const Point& b, const Point& c, const Point& p) {
    const Point ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
    const double d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
    const double d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
    if (va <= 0) {
        const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {0, 1 - w, w};
    }
    return Eigen::Vector3d(va, vb, vc) / (va + vb + vc);
}

struct Nearest {
    Weights weights = Weights::Zero();
    double squared_distance = std::numeric_limits<double>::infinity();
};

Nearest nearest_in_cell(const Corners& t, const Point& p) {
    const Weights inside = barycentric(t, p);
    if (inside.minCoeff() >= 0) return {inside, 0};
    Nearest best;
    for (const auto& f : volmesh::tet::face_vertices) {
        const Eigen::Vector3d on_face = nearest_on_triangle(t[f[0]], t[f[1]], t[f[2]], p);
        Nearest found{Weights::Zero(), 0};
        Point q = Point::Zero();
        for (int i = 0; i < 3; ++i) {
            found.weights[f[i]] = on_face[i];
            q += on_face[i] * t[f[i]];
        }
        found.squared_distance = (p - q).squaredNorm();
        if (found.squared_distance < best.squared_distance) best = found;
    }
    return best;
}

/// The cells of a mesh with a value at each of their corners, and a tree of their boxes.
class CellValues {
  public:
    CellValues(const TetMesh& mesh, std::vector<Weights> values) : values_(std::move(values)) {
        std::vector<TreeEntry> boxes;
        for (const auto cell : mesh.cells()) {
            const Corners t = mesh.cell_points(cell);
            const Point low = t[0].cwiseMin(t[1]).cwiseMin(t[2]).cwiseMin(t[3]);
            const Point high = t[0].cwiseMax(t[1]).cwiseMax(t[2]).cwiseMax(t[3]);
            boxes.emplace_back(TreeBox(tree_point(low), tree_point(high)),
                               static_cast<std::uint32_t>(corners_.size()));
            corners_.push_back(t);
        }
        tree_ = Tree(boxes);
    }

    /// The value in the nearest cell, at its point nearest to p; of several cells equally near, in the first.
    double operator()(const Point& p) const {
        Nearest best;
        std::uint32_t cell = 0;
        const TreePoint place = tree_point(p);
        for (auto it = tree_.qbegin(bgi::nearest(place, static_cast<unsigned>(corners_.size())));
             it != tree_.qend(); ++it) {
            if (boost::geometry::comparable_distance(place, it->first) > best.squared_distance) break;
            const Nearest found = nearest_in_cell(corners_[it->second], p);
            if (found.squared_distance < best.squared_distance ||
                (found.squared_distance == best.squared_distance && it->second < cell)) {
                best = found;
                cell = it->second;
            }
        }
        // Written so that equal values give just that value.
        const Weights& values = values_[cell];
        return values[0] + best.weights.dot(values - Weights::Constant(values[0]));
    }

  private:
    std::vector<Corners> corners_;
    std::vector<Weights> values_;
    Tree tree_;
};

void require_size(double value, const std::string& property, const char* kind, std::uint32_t index,
                  const Point& p) {
    if (value > 0 && std::isfinite(value)) return;
    throw InputError(
        fmt::format("the size \"{}\" is {} at {} {}, ({}, {}, {}); it must be positive and finite", property,
                    value, kind, index, p.x(), p.y(), p.z()));
}

/// The values at the corners of each cell.
std::vector<Weights> corner_values(const TetMesh& mesh, const std::string& property) {
    std::vector<Weights> values;
    volmesh::VPropHandleT<double> at_vertices;
    volmesh::CPropHandleT<double> in_cells;
    if (mesh.get_property_handle(at_vertices, property)) {
        for (const auto cell : mesh.cells()) {
            Weights corners;
            for (int i = 0; i < 4; ++i) {
                const auto v = mesh.cell_vertex(cell, i);
                corners[i] = mesh.property(at_vertices, v);
                require_size(corners[i], property, "vertex", v.idx(), mesh.point(v));
            }
            values.push_back(corners);
        }
    } else if (mesh.get_property_handle(in_cells, property)) {
        for (const auto cell : mesh.cells()) {
            const double value = mesh.property(in_cells, volmesh::CellHandle(cell));
            require_size(value, property, "cell", cell.idx(), mesh.point(mesh.cell_vertex(cell, 0)));
            values.push_back(Weights::Constant(value));
        }
    } else {
        throw InputError(
            fmt::format("the mesh has no vertex or cell field of real numbers named \"{}\"", property));
    }
    return values;
}

}  // namespace

SizeField mesh_size(const TetMesh& mesh, const std::string& property) {
    std::vector<Weights> values = corner_values(mesh, property);
    if (values.empty()) throw InputError("a size field needs a mesh with at least one cell");
    const auto cells = std::make_shared<const CellValues>(mesh, std::move(values));
    return SizeField([cells](const Point& p) { return (*cells)(p); },
                     fmt::format("the size field \"{}\"", property));
}

}  // namespace maille::refine
