#include "modeler/arrange.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "modeler/arrange_boxes.hh"
#include "modeler/arrange_cluster.hh"
#include "modeler/arrange_coarsen.hh"
#include "modeler/arrange_label.hh"
#include "modeler/arrange_restore.hh"
#include "modeler/arrange_scene.hh"
#include "modeler/arrange_self_intersection.hh"
#include "modeler/arrange_simplify.hh"
#include "volmesh/error.hh"

namespace maille::modeler {

namespace {

using namespace detail;

Arrangement arrange_pairs(const Scene& scene, const ExactPositions& positions, std::span<const Pair> pairs,
                          const CsgTree& tree, std::size_t most_contacts) {
    PointRegistry registry(positions.points, 1e-6 * diagonal(scene.complex),
                           most_contacts - std::min(most_contacts, pairs.size()));
    const Contacts contacts = intersect(scene.complex, positions, pairs, registry);
    const Subdivision subdivision = subdivide(scene.complex, positions, contacts, registry);
    const std::vector<Sides> sides = label_sheets(subdivision, scene.complex, positions, registry, tree);
    return simplify(subdivision, sides, scene, registry);
}

/// Pairs of facets of one primitive, which crosses itself, that meet.
void add_own_pairs(const FacetComplex& complex, std::span<const ClosedSurface> primitives,
                   std::vector<Pair>& pairs) {
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        if (!primitives[i].crosses_itself) continue;
        FacetComplex own{complex.points, {}};
        std::vector<std::uint32_t> numbers;
        for (std::uint32_t f = 0; f < complex.facets.size(); ++f)
            if (complex.facets[f].back == static_cast<Region>(i)) {
                own.facets.push_back(complex.facets[f]);
                numbers.push_back(f);
            }
        for (const auto& [first, second] : find_self_intersections(own))
            if (first != second) pairs.emplace_back(numbers[first], numbers[second]);
    }
}

/// Pairs of near facets of different primitives, of facets without area with all others, and of facets of one
/// primitive that meet.
std::vector<Pair> pairs_to_intersect(const FacetComplex& complex, std::span<const ClosedSurface> primitives,
                                     double margin, std::size_t most) {
    const std::vector<bool> degenerate = degenerate_facets(complex, positions_as_given(complex));
    std::size_t count = 0;
    std::vector<Pair> pairs = pairs_of_near_facets(complex, margin, [&](std::uint32_t i, std::uint32_t j) {
        if (complex.facets[i].back == complex.facets[j].back && !degenerate[i] && !degenerate[j])
            return false;
        if (++count > most) fail_for_work(complex, std::array{i, j});
        return true;
    });
    add_own_pairs(complex, primitives, pairs);
    std::ranges::sort(pairs);
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

/// The pairs that make a complex unfit: those that cross, and facets without area with all near ones. Nothing
/// if it is fit.
std::optional<std::vector<Pair>> pairs_to_repair(const FacetComplex& complex) {
    const std::vector<SelfIntersection> found = find_self_intersections(complex);
    if (found.empty()) return std::nullopt;
    std::vector<Pair> pairs;
    std::vector<bool> degenerate(complex.facets.size());
    for (const auto& [i, j] : found) {
        if (i == j)
            degenerate[i] = true;
        else
            pairs.emplace_back(i, j);
    }
    const auto near =
        pairs_of_near_facets(complex, 0, [&](auto i, auto j) { return degenerate[i] || degenerate[j]; });
    pairs.insert(pairs.end(), near.begin(), near.end());
    std::ranges::sort(pairs);
    return pairs;
}

/// The tree that takes each region as a primitive; the earlier one wins where rounding made them overlap.
CsgTree tree_of_regions(const FacetComplex& complex) {
    std::vector<Region> regions;
    for (const Facet& f : complex.facets)
        for (const auto r : {f.front, f.back})
            if (r != outside) regions.push_back(r);
    std::ranges::sort(regions);
    regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
    CsgTree tree{Operation::fragment};
    for (const auto r : regions) tree.children.push_back({Operation::leaf, static_cast<std::uint32_t>(r)});
    return tree;
}

void mark_whole_facets(Arrangement& arrangement, std::span<const ClosedSurface> primitives) {
    const auto less = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    };
    for (std::size_t i = 0; i < arrangement.parents.size(); ++i) {
        FacetParent& parent = arrangement.parents[i];
        const ClosedSurface& surface = primitives[parent.primitive];
        std::array<Eigen::Vector3d, 3> now, before;
        for (std::size_t k = 0; k < 3; ++k) {
            now[k] = arrangement.complex.points[arrangement.complex.facets[i].vertices[k]];
            before[k] = surface.points[surface.triangles[parent.triangle][k]];
        }
        std::ranges::sort(now, less);
        std::ranges::sort(before, less);
        parent.whole = now == before;
    }
}

/// A facet at whose edges those around one of its regions do not match, if there is one.
std::optional<std::uint32_t> open_facet(const FacetComplex& complex) {
    std::map<std::pair<Region, std::uint64_t>, int> balance;
    for (const Facet& f : complex.facets)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto a = f.vertices[k], b = f.vertices[(k + 1) % 3];
            const int sense = a < b ? 1 : -1;
            balance[{f.back, edge_key(a, b)}] += sense;
            balance[{f.front, edge_key(a, b)}] -= sense;
        }
    for (std::uint32_t i = 0; i < complex.facets.size(); ++i) {
        const Facet& f = complex.facets[i];
        for (std::size_t k = 0; k < 3; ++k)
            for (const Region r : {f.front, f.back})
                if (balance.at({r, edge_key(f.vertices[k], f.vertices[(k + 1) % 3])}) != 0) return i;
    }
    return std::nullopt;
}

bool is_closed(const FacetComplex& complex) {
    return !open_facet(complex);
}

/// Tells the primitives whose surfaces, or whose regions, the facets are.
[[noreturn]] void fail_at(const Arrangement& arrangement, std::span<const std::uint32_t> facets,
                          const char* problem) {
    std::vector<std::uint32_t> primitives;
    for (const auto f : facets) primitives.push_back(arrangement.parents[f].primitive);
    std::ranges::sort(primitives);
    primitives.erase(std::unique(primitives.begin(), primitives.end()), primitives.end());
    const Facet& first = arrangement.complex.facets[facets[0]];
    throw ArrangeError(problem, std::move(primitives), arrangement.complex.points[first.vertices[0]]);
}

Arrangement arrange_once(std::span<const ClosedSurface> primitives, const CsgTree& tree, double weld_distance,
                         const ArrangeOptions& options) {
    Scene fine = gather(primitives);
    weld(fine, weld_distance);
    if (fine.complex.facets.empty()) return {};
    const CoarseScene coarse = coarsen(fine, weld_distance);
    const Scene& scene = coarse.scene;
    const auto most_contacts = static_cast<std::size_t>(
        std::ceil(options.most_contacts * static_cast<double>(scene.complex.facets.size())));
    const std::vector<Pair> pairs =
        pairs_to_intersect(scene.complex, primitives, weld_distance, most_contacts);
    Arrangement result = arrange_pairs(scene, positions_on_planes(scene.complex, pairs, weld_distance), pairs,
                                       tree, most_contacts);
    for (int round = 0;; ++round) {
        weld(result, weld_distance);
        if (const auto open = open_facet(result.complex))
            fail_at(
                result, std::array{*open},
                "cannot be cut where they meet: the regions between them are not closed; move or turn one "
                "of them a little");
        const auto crossing = pairs_to_repair(result.complex);
        if (!crossing) {
            Arrangement restored = restore(result, fine, coarse, weld_distance);
            if (is_closed(restored.complex) && !find_self_intersection(restored.complex))
                result = std::move(restored);
            mark_whole_facets(result, primitives);
            return result;
        }
        if (round == options.max_repairs)
            fail_at(
                result, std::array{crossing->front().first, crossing->front().second},
                "come so near to each other that they cannot be told apart in double precision; move them "
                "apart or make them coincide");
        result = arrange_pairs(result, positions_as_given(result.complex), *crossing,
                               tree_of_regions(result.complex), most_contacts);
    }
}

void check_tree(const CsgTree& tree, std::size_t n_primitives) {
    if (tree.operation == Operation::leaf && tree.primitive >= n_primitives)
        throw InputError(
            fmt::format("the tree names primitive {}, but there are only {}", tree.primitive, n_primitives));
    for (const CsgTree& child : tree.children) check_tree(child, n_primitives);
}

}  // namespace

ArrangeError::ArrangeError(std::string problem, std::vector<std::uint32_t> primitives,
                           const Eigen::Vector3d& place)
    : InputError(fmt::format("the surfaces of primitives {} near ({:.9g}, {:.9g}, {:.9g}) {}",
                             fmt::join(primitives, " and "), place.x(), place.y(), place.z(), problem)),
      problem_(std::move(problem)),
      primitives_(std::move(primitives)),
      place_(place) {}

Arrangement arrange(std::span<const ClosedSurface> primitives, const CsgTree& tree,
                    const ArrangeOptions& options) {
    check_tree(tree, primitives.size());
    const double weld_distance = tolerance(gather(primitives).complex, options.weld);
    std::optional<ArrangeError> first;
    for (const double times : {1.0, 10.0, 100.0}) try {
            return arrange_once(primitives, tree, times * weld_distance, options);
        } catch (const ArrangeLimitError&) {
            throw;
        } catch (const ArrangeError& error) {
            if (!first) first = error;
        }
    throw ArrangeError(*first);
}

}  // namespace maille::modeler
