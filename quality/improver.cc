#include "quality/improver.hh"

#include <algorithm>

#include "quality/smooth.hh"

namespace maille::quality {

using volmesh::TetMesh;

Improver::Improver(TetMesh& mesh, std::vector<Shape> shapes, const ImproveOptions& options,
                   const volmesh::Projector* projector, ImproveResult& result)
    : mesh_(mesh),
      options_(options),
      limit_(options.size, options.ratio),
      projector_(projector),
      surfaces_of_(mesh, projector),
      freedoms_(mesh, projector),
      freedom_at_(mesh.n_vertices(), 0),
      known_freedoms_(2),
      shapes_(std::move(shapes)),
      changed_(mesh.n_vertices(), 1),
      smoothed_(mesh.n_vertices(), 0),
      result_(result) {}

double Improver::worst() const {
    double least = 1;
    for (const Shape& shape : shapes_) least = std::min(least, shape.objective);
    return least;
}

Improver::Pass Improver::pass(bool all_moves, std::size_t most_tries) {
    std::vector<std::uint32_t> bad;
    for (std::uint32_t i = 0; i < mesh_.n_cells(); ++i)
        if (shapes_[i].objective < options_.good_enough) bad.push_back(i);
    std::ranges::sort(bad, [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(shapes_[a].objective, a) < std::pair(shapes_[b].objective, b);
    });
    const std::size_t before = result_.edits();
    for (auto& tried : tried_) tried.resize(mesh_.n_cells(), 0);
    std::size_t tries = 0;
    for (std::uint32_t i : bad) {
        if (tries == most_tries) break;
        const CellHandle c(i);
        if (mesh_.is_deleted(c) || shapes_[i].objective >= options_.good_enough) continue;
        const auto has_changed = [&](VertexHandle v) { return changed_[v.idx()] > tried_[all_moves][i]; };
        if (!std::ranges::any_of(mesh_.cell_vertices(c), has_changed)) continue;
        tried_[0][i] = now_;
        if (all_moves) tried_[1][i] = now_;
        ++tries;
        improve_cell(c, all_moves);
    }
    ++result_.passes;
    return {tries, result_.edits() - before};
}

bool Improver::improve_cell(CellHandle c, bool all_moves) {
    if (options_.may_change_cells && flip(c)) return true;
    bool has_moved = false;
    for (VertexHandle v : mesh_.cell_vertices(c)) {
        has_moved |= smooth(v);
        if (shapes_[c.idx()].objective >= options_.good_enough) return true;
    }
    if (has_moved || !all_moves || !options_.may_change_cells) return has_moved;
    return collapse(c) || split(c);
}

double Improver::quality(const CellList& cells) const {
    double least = std::numeric_limits<double>::infinity();
    for (CellHandle c : cells) least = std::min(least, shapes_[c.idx()].objective);
    return least;
}

const Freedom& Improver::freedom(VertexHandle v, const CellList& cells) {
    std::uint32_t& at = freedom_at_[v.idx()];
    if (at == 0) {
        Freedom found = freedoms_(v, cells);
        at = found.is_free() ? 1 : static_cast<std::uint32_t>(known_freedoms_.size());
        if (!found.is_free()) known_freedoms_.push_back(std::move(found));
    }
    return known_freedoms_[at];
}

Bases Improver::bases_at(VertexHandle v, const CellList& cells) const {
    Bases bases;
    for (CellHandle c : cells) {
        const auto face = mesh_.halfface_vertices(TetMesh::halfface(c, mesh_.local_vertex(c, v)));
        bases.push_back({mesh_.point(face[0]), mesh_.point(face[1]), mesh_.point(face[2])});
    }
    return bases;
}

void Improver::settle(const CellList& changed, std::uint32_t first_new) {
    ++now_;
    shapes_.resize(mesh_.n_cells(), perfect_shape);
    for (auto& tried : tried_) tried.resize(mesh_.n_cells(), 0);
    changed_.resize(mesh_.n_vertices(), 0);
    smoothed_.resize(mesh_.n_vertices(), 0);
    freedom_at_.resize(mesh_.n_vertices(), 0);
    const auto measure = [&](CellHandle c) {
        const auto p = mesh_.cell_points(c);
        note_shape(c, mesh_.is_deleted(c) ? perfect_shape : shape(p[0], p[1], p[2], p[3]));
    };
    for (CellHandle c : changed) measure(c);
    for (std::uint32_t i = first_new; i < mesh_.n_cells(); ++i) measure(CellHandle(i));
}

void Improver::note_shape(CellHandle c, const Shape& shape) {
    shapes_[c.idx()] = shape;
    for (VertexHandle v : mesh_.cell_vertices(c)) changed_[v.idx()] = now_;
}

double Improver::excess(const CellList& cells) const {
    double worst = 1;
    if (!limit_.exists()) return worst;
    for (CellHandle c : cells) worst = std::max(worst, limit_.excess(mesh_.cell_points(c)));
    return worst;
}

}  // namespace maille::quality
