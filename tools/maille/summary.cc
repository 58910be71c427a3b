#include "tools/maille/summary.hh"

#include <fmt/format.h>

namespace maille::tools {
namespace {

void print_json(const Summary& summary, const volmesh::TetMesh& mesh) {
    nlohmann::ordered_json json{
        {"cells", mesh.n_cells()},
        {"vertices", mesh.n_vertices()},
        {"iterations", summary.iterations},
        {"projection", {{"moved", summary.moved}, {"short_of_target", summary.short_of_target}}},
        {"edits", summary.edits}};
    summary.clock.write_to(json);
    fmt::print("{}\n", json.dump(2));
}

void print_text(const Summary& summary, const volmesh::TetMesh& mesh, const std::string& path) {
    fmt::print("{}: {} cells, {} vertices, {} sets\n", path, mesh.n_cells(), mesh.n_vertices(),
               mesh.n_sets());
    if (summary.iterations > 0) fmt::print("refined in {} passes\n", summary.iterations);
    if (summary.iterations > 0 || summary.short_of_target > 0)
        fmt::print("{} vertices moved onto their surfaces, {} short of them\n", summary.moved,
                   summary.short_of_target);
    if (summary.edits > 0) fmt::print("improved by {} edits\n", summary.edits);
    fmt::print("{:.2f} s, {:.2f} s of processor time\n", summary.clock.total().wall,
               summary.clock.total().cpu);
}

}  // namespace

void Summary::add(const refine::RefineResult& result, bool has_projected) {
    iterations += result.iterations;
    if (has_projected) add(result.projection);
}

void Summary::add(const quality::ProjectionResult& projection) {
    moved += projection.moved;
    short_of_target = projection.short_of_target.size();
}

void Summary::print(const volmesh::TetMesh& mesh, const std::string& path,
                    const CommonOptions& options) const {
    if (options.json)
        print_json(*this, mesh);
    else if (!options.quiet)
        print_text(*this, mesh, path);
}

}  // namespace maille::tools
