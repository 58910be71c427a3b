#pragma once

#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "modeler/model.hh"
#include "modeler/tessellate.hh"
#include "tests/modeler/surface_checks.hh"
#include "volmesh/error.hh"

namespace maille::modeler::test {

inline Model model_of(const std::string& text, Facets facets = Facets::automatic) {
    return parse_model(text, "part.csg", facets);
}

inline bool contains(const Model& model, const Point& p) {
    return owner(model.tree, [&](std::uint32_t i) { return model.primitives[i].shape->contains(p); })
        .has_value();
}

/// Compares the model with a hand-written inside test on random points.
template <typename Inside>
void check_inside(const Model& model, const Inside& inside, double reach = 3) {
    std::mt19937_64 random(20210131);
    std::uniform_real_distribution<double> coordinate(-reach, reach);
    int wrong = 0;
    int found = 0;
    for (int i = 0; i < 5000; ++i) {
        const Point p(coordinate(random), coordinate(random), coordinate(random));
        wrong += contains(model, p) != inside(p);
        found += inside(p);
    }
    CHECK(wrong == 0);
    CHECK(found > 10);
}

template <typename Inside>
void check_solid(const std::string& text, const Inside& inside, double reach = 3) {
    CAPTURE(text);
    check_inside(model_of(text), inside, reach);
}

inline bool in_box(const Point& p, const Point& low, const Point& high) {
    return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
}

/// Of a primitive's surface in large triangles, which has to be closed and turned outwards.
inline SurfaceFigures figures_of(const Primitive& primitive, double size = 1e3) {
    const SurfaceFigures figures = measure(tessellate(primitive, size), *primitive.shape);
    CHECK(figures.closed);
    CHECK(figures.oriented);
    return figures;
}

inline std::string message_of(const std::string& text) {
    try {
        parse_model(text, "part.csg");
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

inline std::vector<std::string> surface_names(const Model& model) {
    std::vector<std::string> names;
    for (const ModelSurface& surface : surfaces(model)) names.push_back(surface.name);
    return names;
}

inline std::set<std::string> distinct(const std::vector<std::string>& names) {
    return {names.begin(), names.end()};
}

}  // namespace maille::modeler::test
