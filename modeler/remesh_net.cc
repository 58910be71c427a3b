#include "modeler/remesh_net.hh"

#include <algorithm>
#include <cassert>

namespace maille::modeler::remeshing {

namespace {

void sort_unique(auto& values) {
    std::ranges::sort(values);
    values.erase(std::ranges::unique(values).begin(), values.end());
}

}  // namespace

Index apex(const Triangle& triangle, Index a, Index b) {
    for (const Index v : triangle.vertices)
        if (v != a && v != b) return v;
    return none;
}

bool runs_along(const Triangle& triangle, Index a, Index b) {
    const auto& [p, q, r] = triangle.vertices;
    return (p == a && q == b) || (q == a && r == b) || (r == a && p == b);
}

bool contains(const Triangle& triangle, Index v) {
    return std::ranges::find(triangle.vertices, v) != triangle.vertices.end();
}

Triangle replaced(Triangle triangle, Index from, Index to) {
    std::ranges::replace(triangle.vertices, from, to);
    return triangle;
}

void Net::set_patches(std::vector<Patch> patches, std::span<const Index> patch_of) {
    patches_ = std::move(patches);
    for (Index t = 0; t < n_triangles(); ++t) triangles_[t].patch = patch_of[t];
}

Index Net::add_vertex(const Vec3& point, VertexKind kind, double size) {
    points_.push_back(point);
    kinds_.push_back(kind);
    sizes_.push_back(size);
    touched_.push_back(now_);
    around_.emplace_back();
    return n_vertices() - 1;
}

void Net::drop_last_vertex() {
    assert(around_.back().empty());
    points_.pop_back();
    kinds_.pop_back();
    sizes_.pop_back();
    touched_.pop_back();
    around_.pop_back();
}

void Net::add_triangle(const Triangle& triangle) {
    Index t = n_triangles();
    if (unused_.empty()) {
        triangles_.push_back(triangle);
    } else {
        t = unused_.back();
        unused_.pop_back();
        triangles_[t] = triangle;
    }
    attach(t);
}

void Net::attach(Index t) {
    for (const Index v : triangles_[t].vertices) {
        around_[v].push_back(t);
        touched_[v] = now_;
    }
    tree_.insert({t, corners(t)});
}

void Net::detach(Index t) {
    for (const Index v : triangles_[t].vertices) {
        std::erase(around_[v], t);
        touched_[v] = now_;
    }
    tree_.erase(t);
}

void Net::set_size(Index v, double size) {
    if (sizes_[v] != size) touched_[v] = ++now_;
    sizes_[v] = size;
}

void Net::apply(const Change& change) {
    ++now_;
    for (const Index t : change.removed) detach(t);
    if (change.moved != none) points_[change.moved] = change.position;
    // A change with as many triangles as before keeps their numbers.
    for (std::size_t i = change.removed.size(); i-- > 0;) {
        triangles_[change.removed[i]].patch = none;
        unused_.push_back(change.removed[i]);
    }
    for (const Triangle& triangle : change.added) add_triangle(triangle);
}

void Net::pack_tree() {
    std::vector<TriangleTree::Entry> entries;
    for (Index t = 0; t < n_triangles(); ++t)
        if (is_alive(t)) entries.push_back({t, corners(t)});
    tree_ = TriangleTree(entries);
}

Corners Net::corners(Index t) const {
    const auto& [a, b, c] = triangles_[t].vertices;
    return {points_[a], points_[b], points_[c]};
}

std::vector<Index> Net::triangles_at(Index a, Index b) const {
    std::vector<Index> found;
    for (const Index t : around_[a])
        if (contains(triangles_[t], b)) found.push_back(t);
    return found;
}

std::vector<Index> Net::neighbours(Index v) const {
    std::vector<Index> found;
    for (const Index t : around_[v])
        for (const Index w : triangles_[t].vertices)
            if (w != v) found.push_back(w);
    sort_unique(found);
    return found;
}

bool Net::has_edge(Index a, Index b) const {
    return std::ranges::any_of(around_[a], [&](Index t) { return contains(triangles_[t], b); });
}

bool Net::is_feature(Index a, Index b) const {
    Index first = none;
    Index second = none;
    for (const Index t : around_[a]) {
        if (!contains(triangles_[t], b)) continue;
        if (second != none) return true;
        (first == none ? first : second) = t;
    }
    return second == none || triangles_[first].patch != triangles_[second].patch ||
           runs_along(triangles_[first], a, b) == runs_along(triangles_[second], a, b);
}

std::vector<Index> Net::feature_neighbours(Index v) const {
    std::vector<Index> found = neighbours(v);
    std::erase_if(found, [&](Index w) { return !is_feature(v, w); });
    return found;
}

std::vector<std::array<Index, 2>> Net::edges() const {
    std::vector<std::array<Index, 2>> all;
    all.reserve(triangles_.size() * 3 / 2);
    std::vector<Index> higher;
    for (Index v = 0; v < n_vertices(); ++v) {
        higher.clear();
        for (const Index t : around_[v])
            for (const Index w : triangles_[t].vertices)
                if (w > v) higher.push_back(w);
        sort_unique(higher);
        for (const Index w : higher) all.push_back({v, w});
    }
    return all;
}

std::vector<std::uint32_t> Net::surfaces(std::span<const Index> triangles) const {
    std::vector<std::uint32_t> found;
    for (const Index t : triangles) found.push_back(patch(t).surface);
    sort_unique(found);
    return found;
}

}  // namespace maille::modeler::remeshing
