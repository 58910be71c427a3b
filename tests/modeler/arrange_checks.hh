#pragma once

#include <map>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "modeler/arrange_self_intersection.hh"
#include "tests/modeler/surfaces.hh"

/// What arrangements are checked by.
namespace maille::modeler::test {

inline constexpr std::array operations{Operation::join, Operation::intersection, Operation::difference,
                                       Operation::fragment};

/// Facts that hold for every result.
inline void check_sound(const Arrangement& a) {
    REQUIRE(a.parents.size() == a.complex.facets.size());
    CHECK_FALSE(find_self_intersection(a.complex));
    for (const auto& [region, v] : volumes(a.complex)) {
        CHECK(v > 0);
        CHECK(is_closed(shell(a.complex, region)));
    }
    for (const Facet& f : a.complex.facets) CHECK(f.front != f.back);
}

inline double volume_of(const std::vector<ClosedSurface>& primitives, const CsgTree& tree) {
    const Arrangement a = arrange(primitives, tree);
    check_sound(a);
    return total(volumes(a.complex));
}

/// Volume of each region by counting the cells of a grid, for boxes with corners at whole numbers up to `n`.
inline std::map<Region, double> count_cells(const std::vector<std::array<Vector3d, 2>>& boxes,
                                            const CsgTree& tree, int n) {
    std::map<Region, double> counts;
    for (int i = 0; i < n * n * n; ++i) {
        const Vector3d p(i % n + 0.5, i / n % n + 0.5, i / (n * n) + 0.5);
        const auto found = owner(tree, [&](std::uint32_t k) {
            return (p.array() > boxes[k][0].array()).all() && (p.array() < boxes[k][1].array()).all();
        });
        if (found) counts[static_cast<Region>(*found)] += 1;
    }
    return counts;
}

/// The arrangement is sound, and its regions have the volumes expected.
inline void check_volumes(const Arrangement& a, const std::map<Region, double>& expected, double tolerance) {
    check_sound(a);
    const auto found = volumes(a.complex);
    REQUIRE(found.size() == expected.size());
    for (const auto& [region, v] : expected) CHECK(found.at(region) == doctest::Approx(v).epsilon(tolerance));
}

inline CsgTree random_tree(std::mt19937& random, std::uint32_t first, std::uint32_t end) {
    if (end - first == 1) return leaf(first);
    CsgTree tree = node(operations[random() % 4], {});
    for (auto at = first; at < end;) {
        const auto count = 1 + random() % std::max(1U, (end - first) / 2);
        const auto next = std::min(end, at + static_cast<std::uint32_t>(count));
        tree.children.push_back(random_tree(random, at, next));
        at = next;
    }
    return tree;
}

}  // namespace maille::modeler::test
