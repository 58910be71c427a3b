#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "quality/report.hh"

namespace maille::html {

struct PageOptions {
    std::string title;                          ///< what the page calls the mesh
    const quality::WantedSize* size = nullptr;  ///< these two: as the report was made with
    std::span<const double> errors{};
    /// How many cells the page carries, about: it takes some 40 bytes for each. A larger mesh is sent in
    /// part: its boundary, cuts through it, and the worst cells.
    std::size_t max_cells = 250'000;
};

/// The report as one page of HTML that needs nothing else: histograms, and the mesh to be turned, cut open
/// and coloured in the browser. Throws InputError where the file cannot be written; then nothing is left of
/// it.
void write_page(const volmesh::TetMesh& mesh, const quality::Report& report, const std::string& path,
                const PageOptions& options);

}  // namespace maille::html
