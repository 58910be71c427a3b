#pragma once

#include <span>
#include <string>

#include <CLI/App.hpp>

#include "quality/report.hh"

namespace maille::tools {

/// A page of HTML to write the report to.
struct PageOption {
    std::string path;  ///< empty: none is wanted
    std::size_t max_cells = 250'000;
};

/// The options --html and --html-cells.
void add_page_options(CLI::App& command, PageOption& options);

/// Throws InputError where no page can be written there, or the program was built without pages.
void check_page(const PageOption& options);

/// `size` and `errors` are those that the report was made with; `mesh_path` gives the page its title.
void write_page(const PageOption& options, const std::string& mesh_path, const volmesh::TetMesh& mesh,
                const quality::Report& report, const quality::WantedSize* size,
                std::span<const double> errors);

}  // namespace maille::tools
