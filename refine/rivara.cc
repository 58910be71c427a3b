#include "refine/rivara.hh"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include <tbb/parallel_for.h>

namespace maille::refine {
namespace {

using Cells = std::vector<CellHandle>;

/// A cell that is to be bisected, and one in its way, if one was found, when the mesh had so many vertices.
struct Entry {
    CellHandle cell, obstacle;
    std::uint32_t n_vertices = 0;
};
using Entries = std::vector<Entry>;

/// What some cells can do now.
struct Findings {
    EdgeStars stars;   ///< longest edges of all cells round them
    Entries waiting;   ///< for a cell in their way to be bisected first
    Cells in_the_way;  ///< at their longest edges
    Cells stuck;       ///< as a cell in their way can't be split
};

/// Remembers some edges, to spare the work of looking round them again.
class RecentEdges {
  public:
    bool contains(EdgeStars::Edge edge) { return place(edge) == edge; }
    void add(EdgeStars::Edge edge) { place(edge) = edge; }

  private:
    static constexpr std::size_t size = 1024;
    EdgeStars::Edge& place(EdgeStars::Edge edge) {
        return edges_[(std::min(edge.a, edge.b).idx() * 31 + std::max(edge.a, edge.b).idx()) % size];
    }
    std::array<EdgeStars::Edge, size> edges_{};
};

class Closure {
  public:
    explicit Closure(Bisector& bisector) : bisector_(bisector), mesh_(bisector.mesh()) {}

    /// Some cells after the others, each time with all that their closure asks for: so what is made of cells
    /// that are near to each other lies near in memory, however far closures run. The mesh is the same in any
    /// order.
    Cells run(std::span<const CellHandle> cells) {
        constexpr std::size_t block = 16384;
        for (std::size_t begin = 0; begin < cells.size(); begin += block) {
            for (const CellHandle c : cells.subspan(begin, std::min(block, cells.size() - begin)))
                if (!bisector_.is_born(c)) list(c);
            while (!next_.empty()) round(std::exchange(next_, {}));
        }
        return {stuck_.begin(), stuck_.end()};
    }

  private:
    void list(CellHandle c) {
        if (bisector_.list(c)) next_.push_back({c, {}, 0});
    }

    /// Splits what can be split; the rest, and what is in its way, has its turn in the next round.
    void round(const Entries& entries) {
        constexpr std::size_t chunk = 256;
        std::vector<Findings> findings((entries.size() + chunk - 1) / chunk);
        tbb::parallel_for(std::size_t{0}, findings.size(), [&](std::size_t i) {
            findings[i] =
                find(std::span(entries).subspan(i * chunk, std::min(chunk, entries.size() - i * chunk)));
        });
        EdgeStars stars;
        for (const Findings& found : findings) take(found, stars);
        drop_impossible(stars);
        bisector_.split(stars);
    }

    Findings find(std::span<const Entry> entries) const {
        Findings found;
        RecentEdges recent;
        for (const Entry& entry : entries) {
            if (!bisector_.is_listed(entry.cell)) continue;
            if (entry.obstacle.is_valid() && is_there_still(entry))
                found.waiting.push_back(entry);
            else
                look_round(entry.cell, found, recent);
        }
        return found;
    }

    /// Whether the cell in the way is to be bisected and hasn't been, for then it would have a new vertex.
    bool is_there_still(const Entry& entry) const {
        const auto is_new = [&](VertexHandle v) { return v.idx() >= entry.n_vertices; };
        return bisector_.is_listed(entry.obstacle) &&
               std::ranges::none_of(mesh_.cell_vertices(entry.obstacle), is_new);
    }

    /// Looks at the cells round the longest edge of a cell.
    void look_round(CellHandle c, Findings& found, RecentEdges& recent) const {
        const EdgeStars::Edge edge = bisector_.longest_edge(c);
        if (recent.contains(edge)) return;
        const CellList ring = mesh_.cells_around(c, bisector_.longest(c));
        CellHandle obstacle;
        for (const CellHandle other : ring) {
            if (bisector_.longest_edge(other) == edge) continue;
            if (!stuck_.empty() && stuck_.contains(other)) {
                found.stuck.push_back(c);
                return;
            }
            found.in_the_way.push_back(other);
            obstacle = other;
        }
        if (obstacle.is_valid()) {
            found.waiting.push_back({c, obstacle, mesh_.n_vertices()});
        } else {
            found.stars.add(edge, {ring.data(), ring.size()});
            recent.add(edge);
        }
    }

    void take(const Findings& found, EdgeStars& stars) {
        for (std::size_t i = 0; i < found.stars.size(); ++i) {
            const auto ring = found.stars.ring(i);
            // Cells of another chunk may have found it too.
            if (bisector_.claim(std::ranges::min(ring))) stars.add(found.stars.edge(i), ring);
        }
        for (const CellHandle c : found.in_the_way) list(c);
        next_.insert(next_.end(), found.waiting.begin(), found.waiting.end());
        for (const CellHandle c : found.stuck) give_up(c);
    }

    void give_up(CellHandle c) {
        stuck_.insert(c);
        bisector_.unlist(c);
    }

    /// Takes out the edges whose split would invert a child.
    void drop_impossible(EdgeStars& stars) {
        std::vector<std::uint8_t> possible(stars.size());
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, stars.size(), 64), [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i)
                possible[i] = bisector_.can_split(stars.edge(i), stars.ring(i)) ? 1 : 0;
        });
        if (std::ranges::find(possible, 0) == possible.end()) return;
        const EdgeStars all = std::exchange(stars, {});
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (possible[i] != 0) {
                stars.add(all.edge(i), all.ring(i));
            } else {
                for (const CellHandle c : all.ring(i)) give_up(c);
            }
        }
    }

    Bisector& bisector_;
    const TetMesh& mesh_;
    Entries next_;
    std::set<CellHandle> stuck_;
};

}  // namespace

std::vector<CellHandle> bisect_conforming(Bisector& bisector, const std::vector<CellHandle>& cells) {
    return Closure(bisector).run(cells);
}

}  // namespace maille::refine
