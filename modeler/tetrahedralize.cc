#include "modeler/tetrahedralize.hh"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include <Eigen/Geometry>
#include <fmt/core.h>

#include "modeler/tetgen_order.hh"
#include "modeler/tetgen_process.hh"
#include "modeler/tetrahedralize_check.hh"
#include "volmesh/error.hh"

namespace maille::modeler {
namespace {

using tetgen::Answer;
using tetgen::Request;

/// One way to ask TetGen.
struct Rung {
    bool keep_facets = true;
    bool refine = true;
    double jitter = 0;        ///< relative to the diagonal
    double tolerance = 1e-8;  ///< below which TetGen takes four points for coplanar
    const char* words = "";
};

constexpr std::array<Rung, 8> ladder{{
    {.words = "as it is"},
    {.tolerance = 1e-12, .words = "with a tolerance of 1e-12"},
    {.jitter = 1e-10, .words = "with its points shifted by 1e-10 of the diagonal"},
    {.keep_facets = false, .words = "with facets split"},
    {.jitter = 1e-8, .words = "with its points shifted by 1e-8 of the diagonal"},
    {.keep_facets = false,
     .jitter = 1e-10,
     .words = "with facets split and points shifted by 1e-10 of the diagonal"},
    {.refine = false, .words = "without refinement"},
    {.refine = false, .jitter = 1e-8, .words = "without refinement, points shifted by 1e-8 of the diagonal"},
}};

constexpr std::size_t most_cells_in_cache = 100'000;

/// Volume of a regular tetrahedron: what TetGen may make the largest.
double volume_of_size(double size) {
    return size * size * size / (6 * std::numbers::sqrt2);
}

double processor_time(const FacetComplex& complex, std::span<const double> sizes,
                      const TetrahedralizeOptions& options) {
    if (options.time_limit > 0) return options.time_limit;
    double cells = 10.0 * static_cast<double>(complex.facets.size());
    const std::vector<double> volumes = tetgen::region_volumes(complex);
    for (std::size_t r = 0; r < volumes.size(); ++r) cells += 3 * volumes[r] / volume_of_size(sizes[r]);
    return 10 + 2e-4 * cells;
}

std::vector<Eigen::Vector3d> jittered(std::vector<Eigen::Vector3d> points, double relative) {
    if (relative == 0) return points;
    Eigen::AlignedBox3d box;
    for (const auto& p : points) box.extend(p);
    std::mt19937_64 random(1);
    const double reach = relative * box.diagonal().norm();
    const auto shift = [&] { return reach * (2 * static_cast<double>(random() >> 11) * 0x1p-53 - 1); };
    for (auto& p : points)
        for (int k = 0; k < 3; ++k) p[k] += shift();
    return points;
}

ComplexMesh cells_of_regions(Answer answer, std::span<const Region> regions) {
    ComplexMesh mesh;
    std::vector<std::uint32_t> numbers(answer.cells.size(), tetgen::no_cell);
    for (std::size_t c = 0; c < answer.cells.size(); ++c) {
        if (regions[c] < 0) continue;
        numbers[c] = static_cast<std::uint32_t>(mesh.cells.size());
        mesh.cells.push_back(answer.cells[c]);
        mesh.regions.push_back(regions[c]);
        mesh.neighbors.push_back(answer.neighbors[c]);
    }
    for (auto& neighbors : mesh.neighbors)
        for (std::uint32_t& c : neighbors)
            if (c != tetgen::no_cell) c = numbers[c];
    mesh.points = std::move(answer.points);
    mesh.facets = std::move(answer.facets);
    mesh.parents = std::move(answer.parents);
    return mesh;
}

/// Throws tetgen::Failure where TetGen fails or its mesh is not right.
ComplexMesh attempt(const FacetComplex& complex, std::span<const double> sizes, double time_limit,
                    const Rung& rung) {
    Request request;
    request.processor_time = time_limit;
    request.points = jittered(complex.points, rung.jitter);
    for (const Facet& facet : complex.facets) request.facets.push_back(facet.vertices);
    const std::string common = fmt::format("{}nQT{}", rung.keep_facets ? "Y" : "", rung.tolerance);
    request.switches = "p" + common;
    const bool one_region = std::ranges::none_of(complex.facets, [](const Facet& f) {
        return std::min(f.front, f.back) != outside || std::max(f.front, f.back) != 0;
    });
    if (rung.refine) {
        // TetGen would fill and refine cavities too.
        for (const Facet& facet : complex.facets) request.sides.push_back({facet.front, facet.back});
        for (const double size : sizes) request.max_volumes.push_back(volume_of_size(size));
        request.switches = one_region
                               ? fmt::format("pq1.4/14{}o/140a{:.17g}", common, volume_of_size(sizes[0]))
                               : fmt::format("pq1.4/12A{}o/140a", common);
    }
    Answer answer = tetgen::run(request);
    tetgen::check_complete(answer, request);
    if (answer.cells.size() > most_cells_in_cache) tetgen::order_along_curve(answer, request.points.size());
    std::ranges::copy(complex.points, answer.points.begin());
    const std::vector<Region> regions = tetgen::find_regions(answer, complex);
    tetgen::check_geometry(answer, regions, complex);
    return cells_of_regions(std::move(answer), regions);
}

}  // namespace

volmesh::Column<volmesh::TetMesh::Cell> linked_cells(const ComplexMesh& mesh) {
    // The half-face of a cell that it shares with another one, across the face opposite the other's vertex k.
    const auto halfface_towards = [&](std::uint32_t c, std::uint32_t other, std::size_t k) {
        const auto& neighbors = mesh.neighbors[c];
        const auto local = std::ranges::find(neighbors, other) - neighbors.begin();
        bool fits = local < 4;
        for (std::size_t i = 0; i < 4; ++i)
            fits = fits && (std::ranges::find(mesh.cells[c], mesh.cells[other][i]) != mesh.cells[c].end()) ==
                               (i != k);
        if (!fits) throw InputError("TetGen's tetrahedra do not fit to those that it told to be beside them");
        return 4 * c + static_cast<std::uint32_t>(local);
    };
    volmesh::Column<volmesh::TetMesh::Cell> cells;
    cells.grow(mesh.cells.size());
    for (std::uint32_t c = 0; c < mesh.cells.size(); ++c) {
        cells[c].vertices = mesh.cells[c];
        for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t next = mesh.neighbors[c][k];
            cells[c].neighbors[k] =
                next == tetgen::no_cell ? volmesh::TetMesh::none : halfface_towards(next, c, k);
        }
    }
    return cells;
}

ComplexMesh tetrahedralize(const FacetComplex& complex, std::span<const double> sizes,
                           const TetrahedralizeOptions& options, std::vector<std::string>* warnings) {
    // TetGen crashes on nothing.
    if (complex.facets.empty()) return {};
    double time_limit = processor_time(complex, sizes, options);
    const bool may_split = std::ranges::none_of(complex.facets, &Facet::frozen);
    std::string reasons;
    for (const Rung& rung : ladder) {
        if (!rung.keep_facets && !may_split) continue;
        try {
            return attempt(complex, sizes, time_limit, rung);
        } catch (const tetgen::Failure& failure) {
            // What hangs once often hangs again: it is not waited for as long.
            if (dynamic_cast<const tetgen::TimeOut*>(&failure) != nullptr) time_limit /= 3;
            const std::string told =
                fmt::format("meshing {} {}: {}", options.name, rung.words, failure.what());
            if (warnings != nullptr) warnings->push_back(told);
            reasons += "; " + told;
        }
    }
    throw InputError(fmt::format("{} could not be filled with tetrahedra{}", options.name, reasons));
}

volmesh::TetMesh tetrahedralize(const volmesh::TriMesh& surface, double size,
                                const TetrahedralizeOptions& options, std::vector<std::string>* warnings) {
    FacetComplex complex;
    for (const auto v : surface.vertices()) complex.points.push_back(surface.point(v));
    for (const auto f : surface.faces()) {
        Facet facet{.vertices = {}, .surface = 0, .front = outside, .back = 0, .frozen = true};
        auto corner = facet.vertices.begin();
        for (const auto v : surface.fv_range(f)) *corner++ = static_cast<std::uint32_t>(v.idx());
        complex.facets.push_back(facet);
    }
    ComplexMesh mesh = tetrahedralize(complex, std::array{size}, options, warnings);
    return volmesh::TetMesh::from_cells(std::move(mesh.points), std::move(mesh.cells));
}

}  // namespace maille::modeler
