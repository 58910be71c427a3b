#include "modeler/coplanar_facets.hh"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "modeler/shape_plane.hh"
#include "modeler/shape_polyhedron.hh"
#include "volmesh/union_find.hh"

namespace maille::modeler {
namespace {

using DirectedEdge = std::pair<std::uint32_t, std::uint32_t>;
using Loop = std::vector<std::uint32_t>;

constexpr std::uint32_t none = ~0U;

class Merger {
  public:
    Merger(std::span<const Point> points, std::span<const Triple> triangles)
        : points_(points), triangles_(triangles), region_(triangles.size(), none) {
        double scale = 0;
        for (const Point& p : points) scale = std::max(scale, p.cwiseAbs().maxCoeff());
        tolerance_ = 4e-15 * scale;
        for (std::uint32_t t = 0; t < triangles.size(); ++t) {
            for (int k = 0; k < 3; ++k) left_[{triangles[t][k], triangles[t][(k + 1) % 3]}] = t;
            areas_.push_back(area(t));
        }
    }

    std::vector<PolyhedronFace> faces() {
        grow_regions();
        std::vector<PolyhedronFace> result;
        std::vector<Point> normals;
        std::vector<std::uint32_t> face_of(triangles_.size());
        std::vector<std::vector<std::uint32_t>> members(n_regions_);
        for (std::uint32_t t = 0; t < triangles_.size(); ++t) members[region_[t]].push_back(t);
        const auto add = [&](std::vector<Loop> loops, std::span<const std::uint32_t> of) {
            for (const std::uint32_t t : of) face_of[t] = static_cast<std::uint32_t>(result.size());
            normals.push_back(area_vector(points_, loops).normalized());
            result.push_back({std::move(loops), {}});
        };
        for (const auto& region : members) {
            if (auto loops = outline(region); !loops.empty())
                add(std::move(loops), region);
            else
                for (const std::uint32_t& t : region)
                    add({{triangles_[t].begin(), triangles_[t].end()}}, std::span(&t, 1));
        }
        name(result, normals, face_of);
        return result;
    }

  private:
    Point area(std::uint32_t t) const {
        const auto& [a, b, c] = triangles_[t];
        return (points_[b] - points_[a]).cross(points_[c] - points_[a]);
    }

    template <class Visit>
    void for_each_neighbour(std::uint32_t t, const Visit& visit) const {
        for (int k = 0; k < 3; ++k)
            if (const auto other = left_.find({triangles_[t][(k + 1) % 3], triangles_[t][k]});
                other != left_.end())
                visit(other->second);
    }

    /// From the largest triangles on, whose planes are the surest; then the regions are numbered in the order
    /// of their first triangles.
    void grow_regions() {
        std::vector<std::uint32_t> order(triangles_.size());
        std::iota(order.begin(), order.end(), 0U);
        std::ranges::stable_sort(order, std::greater{},
                                 [&](std::uint32_t t) { return areas_[t].squaredNorm(); });
        for (const std::uint32_t seed : order)
            if (region_[seed] == none) grow(seed);
        std::map<std::uint32_t, std::uint32_t> number;
        for (std::uint32_t& region : region_)
            region = number.try_emplace(region, static_cast<std::uint32_t>(number.size())).first->second;
        n_regions_ = number.size();
    }

    void grow(std::uint32_t seed) {
        const Plane plane(points_[triangles_[seed][0]], areas_[seed]);
        std::vector<std::uint32_t> open{seed};
        region_[seed] = seed;
        if (!(areas_[seed].squaredNorm() > 0)) return;
        while (!open.empty()) {
            const std::uint32_t t = open.back();
            open.pop_back();
            for_each_neighbour(t, [&](std::uint32_t other) {
                if (region_[other] != none || areas_[other].dot(plane.normal()) < 0) return;
                if (std::ranges::any_of(triangles_[other], [&](std::uint32_t v) {
                        return !(std::abs(plane.distance(points_[v])) <= tolerance_);
                    }))
                    return;
                region_[other] = seed;
                open.push_back(other);
            });
        }
    }

    /// The loops around a region, the outer one first; none where they pass a point twice.
    std::vector<Loop> outline(std::span<const std::uint32_t> region) const {
        std::map<std::uint32_t, std::uint32_t> next;
        for (const std::uint32_t t : region)
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t a = triangles_[t][k], b = triangles_[t][(k + 1) % 3];
                const auto other = left_.find({b, a});
                if (other != left_.end() && region_[other->second] == region_[t]) continue;
                if (!next.emplace(a, b).second) return {};
            }
        std::vector<Loop> loops;
        while (!next.empty()) {
            Loop& loop = loops.emplace_back();
            for (auto step = next.begin(); step != next.end(); step = next.find(loop.back())) {
                if (loop.empty()) loop.push_back(step->first);
                loop.push_back(step->second);
                next.erase(step);
            }
            loop.pop_back();
        }
        const auto size = [&](const Loop& loop) { return area_vector(points_, {loop}).norm(); };
        std::ranges::iter_swap(loops.begin(), std::ranges::max_element(loops, {}, size));
        return loops;
    }

    void name(std::vector<PolyhedronFace>& faces, std::span<const Point> normals,
              std::span<const std::uint32_t> face_of) const {
        constexpr double cos_of_crease = 0.866025403784438647;  // 30 degrees
        volmesh::UnionFind patches(faces.size());
        for (std::uint32_t t = 0; t < triangles_.size(); ++t)
            for_each_neighbour(t, [&](std::uint32_t other) {
                if (normals[face_of[t]].dot(normals[face_of[other]]) > cos_of_crease)
                    patches.unite(face_of[t], face_of[other]);
            });
        std::map<std::uint32_t, std::size_t> number;
        for (std::uint32_t f = 0; f < faces.size(); ++f)
            faces[f].name =
                fmt::format("patch{}", number.try_emplace(patches.find(f), number.size()).first->second);
    }

    std::span<const Point> points_;
    std::span<const Triple> triangles_;
    std::map<DirectedEdge, std::uint32_t> left_;
    std::vector<Point> areas_;
    std::vector<std::uint32_t> region_;
    std::size_t n_regions_ = 0;
    double tolerance_ = 0;
};

}  // namespace

std::vector<PolyhedronFace> merge_coplanar(std::span<const Point> points, std::span<const Triple> triangles) {
    return Merger(points, triangles).faces();
}

}  // namespace maille::modeler
