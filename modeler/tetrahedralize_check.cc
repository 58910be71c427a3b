#include "modeler/tetrahedralize_check.hh"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <unordered_map>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/core.h>

#include "modeler/tetgen_process.hh"
#include "modeler/triple.hh"
#include "volmesh/orientation.hh"
#include "volmesh/tet_topology.hh"

namespace maille::modeler::tetgen {
namespace {

std::string at(const Eigen::Vector3d& p) {
    return fmt::format("near ({:.6g}, {:.6g}, {:.6g})", p.x(), p.y(), p.z());
}

Eigen::Vector3d area_vector(const std::vector<Eigen::Vector3d>& points, const Triple& t) {
    return 0.5 * (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
}

double volume(const Answer& answer, std::size_t cell) {
    const auto& [a, b, c, d] = answer.cells[cell];
    const Eigen::Vector3d& o = answer.points[a];
    return (answer.points[b] - o).cross(answer.points[c] - o).dot(answer.points[d] - o) / 6;
}

Triple face(const Answer& answer, std::size_t cell, int local) {
    const auto& v = answer.cells[cell];
    const auto& f = volmesh::tet::face_vertices[local];
    return {v[f[0]], v[f[1]], v[f[2]]};
}

/// The facets of an answer, to be found by their vertices.
class FacetTable {
  public:
    explicit FacetTable(const Answer& answer)
        : on_facet_(answer.points.size()), n_facets_(answer.facets.size()) {
        numbers_.reserve(answer.facets.size());
        for (std::uint32_t f = 0; f < answer.facets.size(); ++f) {
            numbers_.emplace(sorted(answer.facets[f]), f);
            for (std::uint32_t v : answer.facets[f]) on_facet_[v] = 1;
        }
    }
    std::optional<std::uint32_t> find(const Triple& face) const {
        if (!on_facet_[face[0]] || !on_facet_[face[1]] || !on_facet_[face[2]]) return std::nullopt;
        const auto found = numbers_.find(sorted(face));
        return found == numbers_.end() ? std::nullopt : std::optional(found->second);
    }
    std::size_t size() const { return n_facets_; }

  private:
    std::vector<std::uint8_t> on_facet_;
    std::unordered_map<Triple, std::uint32_t, TripleHash> numbers_;
    std::size_t n_facets_;
};

/// Whether the face, seen from outside its cell, turns as the facet does: then the cell lies behind the
/// facet.
bool lies_behind(const Answer& answer, const Triple& face, const Triple& facet) {
    if (sorted(face) == sorted(facet)) return same_turn(face, facet);
    return area_vector(answer.points, face).dot(area_vector(answer.points, facet)) > 0;
}

class RegionFinder {
  public:
    RegionFinder(const Answer& answer, const FacetComplex& complex)
        : answer_(answer), complex_(complex), facets_(answer), sides_seen_(answer.facets.size()) {}

    std::vector<Region> find() {
        regions_.assign(answer_.cells.size(), outside);
        is_seen_.assign(answer_.cells.size(), 0);
        for (std::uint32_t c = 0; c < answer_.cells.size(); ++c)
            if (!is_seen_[c]) flood(c);
        for (std::size_t f = 0; f < sides_seen_.size(); ++f) require_cells_beside(f);
        return std::move(regions_);
    }

  private:
    void flood(std::uint32_t start) {
        std::optional<Region> region;
        std::vector<std::uint32_t> component{start};
        is_seen_[start] = 1;
        for (std::size_t i = 0; i < component.size(); ++i) {
            const std::uint32_t c = component[i];
            for (int k = 0; k < 4; ++k) {
                const Triple outward = face(answer_, c, k);
                if (const auto facet = facets_.find(outward)) {
                    const Region told = region_beside(*facet, outward);
                    if (region && *region != told)
                        throw Failure(fmt::format("two regions run into each other {}",
                                                  at(answer_.points[outward[0]])));
                    region = told;
                } else if (const std::uint32_t next = answer_.neighbors[c][k]; next == no_cell) {
                    throw Failure(
                        fmt::format("the mesh ends beside the surface {}", at(answer_.points[outward[0]])));
                } else if (!std::exchange(is_seen_[next], 1)) {
                    component.push_back(next);
                }
            }
        }
        for (std::uint32_t c : component) regions_[c] = region.value_or(outside);
    }

    Region region_beside(std::uint32_t facet, const Triple& outward) {
        const Facet& parent = complex_.facets[answer_.parents[facet]];
        const bool behind = lies_behind(answer_, outward, parent.vertices);
        sides_seen_[facet] |= behind ? 1 : 2;
        return behind ? parent.back : parent.front;
    }

    void require_cells_beside(std::size_t facet) const {
        const Facet& parent = complex_.facets[answer_.parents[facet]];
        const bool complete =
            (parent.back < 0 || (sides_seen_[facet] & 1)) && (parent.front < 0 || (sides_seen_[facet] & 2));
        if (!complete)
            throw Failure(fmt::format("a side of the surface is empty {}",
                                      at(answer_.points[answer_.facets[facet][0]])));
    }

    const Answer& answer_;
    const FacetComplex& complex_;
    FacetTable facets_;
    std::vector<std::uint8_t> sides_seen_;  ///< bit 0: behind, bit 1: in front
    std::vector<std::uint8_t> is_seen_;     ///< by cell
    std::vector<Region> regions_;
};

/// A sum of signed volumes, with the size of its terms to judge its rounding error by.
struct VolumeSum {
    double value = 0;
    double magnitude = 0;
    void add(double term) {
        value += term;
        magnitude += std::abs(term);
    }
};

std::vector<VolumeSum> volumes_within(const FacetComplex& complex) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& p : complex.points) box.extend(p);
    const Eigen::Vector3d o = box.center();
    std::vector<VolumeSum> sums;
    const auto add = [&](Region region, double term) {
        if (region < 0) return;
        if (sums.size() <= static_cast<std::size_t>(region)) sums.resize(region + 1);
        sums[region].add(term);
    };
    for (const Facet& f : complex.facets) {
        const double term =
            area_vector(complex.points, f.vertices).dot(complex.points[f.vertices[0]] - o) / 3;
        add(f.back, term);
        add(f.front, -term);
    }
    return sums;
}

}  // namespace

std::vector<Region> find_regions(const Answer& answer, const FacetComplex& complex) {
    return RegionFinder(answer, complex).find();
}

void check_complete(const Answer& answer, const Request& request) {
    if (answer.points.size() < request.points.size()) throw Failure("TetGen dropped points");
    for (std::size_t i = 0; i < request.points.size(); ++i)
        if (std::memcmp(answer.points[i].data(), request.points[i].data(), sizeof(Eigen::Vector3d)) != 0)
            throw Failure(fmt::format("TetGen moved or renumbered the point {}", at(request.points[i])));

    std::vector<double> missing(request.facets.size());
    std::vector<std::uint8_t> whole(request.facets.size());
    for (std::size_t f = 0; f < missing.size(); ++f)
        missing[f] = area_vector(request.points, request.facets[f]).norm();
    const std::vector<double> full = missing;
    for (std::size_t f = 0; f < answer.facets.size(); ++f) {
        const std::uint32_t parent = answer.parents[f];
        if (parent >= missing.size()) throw Failure("TetGen's answer names facets that do not exist");
        if (sorted(answer.facets[f]) == sorted(request.facets[parent])) whole[parent] = 1;
        missing[parent] -= area_vector(answer.points, answer.facets[f]).norm();
    }
    for (std::size_t f = 0; f < missing.size(); ++f)
        if (!whole[f] && std::abs(missing[f]) > 1e-6 * full[f])
            throw Failure(fmt::format("TetGen lost a part of the surface {}",
                                      at(request.points[request.facets[f][0]])));
}

void check_geometry(const Answer& answer, std::span<const Region> regions, const FacetComplex& complex) {
    const std::vector<Eigen::Vector3d>& points = answer.points;
    const std::vector<VolumeSum> expected = volumes_within(complex);
    std::vector<double> found(expected.size());
    for (std::size_t c = 0; c < answer.cells.size(); ++c) {
        if (regions[c] < 0) continue;
        const auto& [i, j, k, l] = answer.cells[c];
        if (volmesh::orientation(points[i], points[j], points[k], points[l]) <= 0)
            throw Failure(fmt::format("TetGen made a flat or inverted tetrahedron {}", at(answer.points[i])));
        found[regions[c]] += volume(answer, c);
    }
    for (std::size_t r = 0; r < expected.size(); ++r)
        if (std::abs(found[r] - expected[r].value) > 1e-9 * expected[r].magnitude)
            throw Failure(
                fmt::format("the tetrahedra of region {} have volume {:.12g}, its surface encloses {:.12g}",
                            r, found[r], expected[r].value));
}

std::vector<double> region_volumes(const FacetComplex& complex) {
    std::vector<double> volumes;
    for (const VolumeSum& sum : volumes_within(complex)) volumes.push_back(sum.value);
    return volumes;
}

}  // namespace maille::modeler::tetgen
