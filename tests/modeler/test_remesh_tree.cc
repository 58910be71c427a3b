#include <algorithm>
#include <map>
#include <random>

#include <doctest/doctest.h>

#include "modeler/remesh_tree.hh"

namespace {

using namespace maille::modeler::remeshing;

TEST_CASE("the tree finds the triangles whose boxes meet, after any changes") {
    const unsigned seed = 7;
    CAPTURE(seed);
    std::mt19937 random(seed);
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution(low, high)(random);
    };
    const auto vector = [&](double size) {
        return Vec3(number(-size, size), number(-size, size), number(-size, size));
    };
    // Of all sizes, some in a plane.
    const auto triangle = [&] {
        const double size = std::exp(number(-6, 0));
        const Vec3 place = vector(1);
        Corners corners{place, place + vector(size), place + vector(size)};
        if (random() % 4 == 0)
            for (Vec3& p : corners) p.z() = 0.25;
        return corners;
    };
    std::map<Index, Corners> present;
    for (Index t = 0; t < 200; ++t) present[t] = triangle();
    const auto packed = [&] {
        std::vector<TriangleTree::Entry> entries;
        for (const auto& [t, corners] : present) entries.push_back({t, corners});
        return TriangleTree(entries);
    };
    TriangleTree tree = packed();
    for (int step = 0; step < 3000; ++step) {
        const auto t = static_cast<Index>(random() % 400);
        if (present.contains(t)) tree.erase(t);
        switch (random() % 3) {
            case 0:
                present.erase(t);
                break;
            case 1:
                present[t] = triangle();
                break;
            default:  // a small move
                if (!present.contains(t)) present[t] = triangle();
                present[t][random() % 3] += vector(0.01);
        }
        if (present.contains(t)) tree.insert({t, present[t]});
        if (step % 1000 == 999) tree = packed();

        const Corners asked = triangle();
        std::vector<Index> found, expected;
        tree.collect(asked, found);
        for (const auto& [other, corners] : present)
            if (box_of(corners).intersects(box_of(asked))) expected.push_back(other);
        std::ranges::sort(found);
        REQUIRE(found == expected);
    }
}

}  // namespace
