// Uses every room: builds a model's mesh, refines it and asks for its quality.
#include <cmath>
#include <cstdio>

#include "modeler/build.hh"
#include "quality/report.hh"
#include "refine/refine.hh"
#include "volmesh/measure.hh"

int main(int, char** arguments) {
    using namespace maille;
    auto mesh = modeler::build(modeler::read_model(arguments[1]), {.size = 1});
    const auto before = mesh.n_cells();
    refine::refine(mesh, refine::parse_size("0.3"));
    const bool is_right = mesh.n_cells() > before && std::abs(volmesh::volume(mesh) - 6) < 1e-12 &&
                          quality::assess(mesh).inverted == 0;
    std::puts(is_right ? "right" : "wrong");
    return is_right ? 0 : 1;
}
