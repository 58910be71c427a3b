#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "volmesh/column.hh"
#include "volmesh/error.hh"
#include "volmesh/tet_topology.hh"

// How the cells of a list find their neighbours. The half-faces are sorted into parts by their lowest vertex,
// of which each is small enough for the processor's cache; there a hash table brings the two of a face
// together.
namespace maille::volmesh::linking {

using Index = std::uint32_t;
using Cell = std::array<Index, 4>;

/// A half-face and its vertices, ascending.
struct Side {
    std::array<Index, 3> vertices;
    Index halfface;
    auto operator<=>(const Side&) const = default;
    /// As that of the arrays, without a call.
    bool is_of_same_face(const Side& other) const {
        return vertices[0] == other.vertices[0] && vertices[1] == other.vertices[1] &&
               vertices[2] == other.vertices[2];
    }
};

inline Side side_of(const Cell& cell, Index halfface) {
    const auto& [i, j, k] = tet::face_vertices[halfface % 4];
    const auto [low, high] = std::minmax(cell[i], cell[j]);
    const Index middle = std::min(high, cell[k]);
    return {{std::min(low, middle), std::max(low, middle), std::max(high, cell[k])}, halfface};
}

/// Calls the action with the lowest vertex of each half-face, and the half-face.
template <class Action>
void for_each_lowest(const Cell& cell, Index c, const Action& action) {
    const auto numbered = [&](int i) { return std::uint64_t{cell[i]} << 2 | static_cast<unsigned>(i); };
    const std::uint64_t v0 = numbered(0), v1 = numbered(1), v2 = numbered(2), v3 = numbered(3);
    const std::uint64_t a = std::min(v0, v1), b = std::min(v2, v3);
    const std::uint64_t lowest = std::min(a, b);
    const std::uint64_t second = std::min(std::max(a, b), a < b ? std::max(v0, v1) : std::max(v2, v3));
    const auto local = static_cast<Index>(lowest % 4);
    for (Index k = 1; k < 4; ++k) action(static_cast<Index>(lowest >> 2), 4 * c + (local + k) % 4);
    action(static_cast<Index>(second >> 2), 4 * c + local);
}

/// The half-faces of the cells, part by part.
class Parts {
  public:
    template <class VerticesOf>
    Parts(Index n_vertices, Index n_cells, const VerticesOf& vertices_of) {
        constexpr Index usual = 4096;   // half-faces in a part
        constexpr Index most = 4096;    // parts: more would be too many places to write to at once
        constexpr Index batch = 65536;  // cells that are sorted one after another
        const Index wanted = std::clamp<Index>(4 * n_cells / usual, 1, most);
        while (n_vertices >> shift_ >= wanted) ++shift_;
        const std::size_t n_parts = (n_vertices >> shift_) + 1;
        const std::size_t n_batches = (n_cells + batch - 1) / batch;
        const auto for_each_side = [&](std::size_t b, const auto& action) {
            const auto end = static_cast<Index>(std::min<std::size_t>((b + 1) * batch, n_cells));
            for (auto c = static_cast<Index>(b * batch); c < end; ++c)
                for_each_lowest(vertices_of(c), c,
                                [&](Index v, Index halfface) { action(v >> shift_, halfface); });
        };
        std::vector<std::vector<Index>> places(n_batches, std::vector<Index>(n_parts, 0));
        tbb::parallel_for(std::size_t{0}, n_batches,
                          [&](std::size_t b) { for_each_side(b, [&](Index p, Index) { ++places[b][p]; }); });
        begins_.reserve(n_parts + 1);
        Index sum = 0;
        for (std::size_t p = 0; p < n_parts; ++p) {
            begins_.push_back(sum);
            for (auto& of_batch : places) sum += std::exchange(of_batch[p], sum);
        }
        begins_.push_back(sum);
        halffaces_.grow(sum);
        tbb::parallel_for(std::size_t{0}, n_batches, [&](std::size_t b) {
            for_each_side(b, [&](Index p, Index halfface) { halffaces_[places[b][p]++] = halfface; });
        });
    }

    std::size_t size() const { return begins_.size() - 1; }
    std::span<const Index> operator[](std::size_t p) const {
        return {halffaces_.data() + begins_[p], halffaces_.data() + begins_[p + 1]};
    }

  private:
    int shift_ = 0;
    std::vector<Index> begins_;
    Column<Index> halffaces_;
};

/// Finds the pairs among sides.
class Pairing {
  public:
    template <class VerticesOf>
    void gather(std::span<const Index> halffaces, const VerticesOf& vertices_of) {
        constexpr std::size_t ahead = 24;
        sides_.clear();
        for (std::size_t i = 0; i < halffaces.size(); ++i) {
            if (i + ahead < halffaces.size()) __builtin_prefetch(&vertices_of(halffaces[i + ahead] / 4), 1);
            sides_.push_back(side_of(vertices_of(halffaces[i] / 4), halffaces[i]));
        }
    }

    /// Calls the action for the two half-faces of each face that has two. False where a face has three.
    template <class Link>
    bool link(const Link& link_two) {
        const int bits = std::max(4, static_cast<int>(std::bit_width(sides_.size() + sides_.size() / 2)));
        const std::size_t mask = (std::size_t{1} << bits) - 1;
        places_.assign(mask + 1, free);
        n_single_ = 0;
        for (Index i = 0; i < sides_.size(); ++i) {
            const Side& side = sides_[i];
            for (std::size_t at = hash(side) >> (64 - bits);; at = (at + 1) & mask) {
                if (places_[at] == free) {
                    places_[at] = i;
                    ++n_single_;
                    break;
                }
                const Side& other = sides_[places_[at] & ~paired];
                if (!other.is_of_same_face(side)) continue;
                if ((places_[at] & paired) != 0) return false;
                places_[at] |= paired;
                --n_single_;
                link_two(side.halfface, other.halfface);
                break;
            }
        }
        return true;
    }

    /// Faces that have one half-face only.
    Index n_single() const { return n_single_; }

    /// Says which cells share a face that has more than two.
    [[noreturn]] void fail() {
        std::ranges::sort(sides_);
        for (std::size_t i = 0; i + 2 < sides_.size(); ++i)
            if (sides_[i].vertices == sides_[i + 2].vertices)
                throw InputError(fmt::format(
                    "cells {}, {} and {} all have the face of vertices {}, {} and {}", sides_[i].halfface / 4,
                    sides_[i + 1].halfface / 4, sides_[i + 2].halfface / 4, sides_[i].vertices[0],
                    sides_[i].vertices[1], sides_[i].vertices[2]));
        throw std::logic_error("no face has three cells");
    }

  private:
    static constexpr Index free = ~Index{0};
    static constexpr Index paired = Index{1} << 31;

    static std::uint64_t hash(const Side& side) {
        constexpr std::uint64_t golden = 0x9e3779b97f4a7c15U;
        const auto [a, b, c] = side.vertices;
        return ((a * golden + b) * golden + c) * golden;
    }

    std::vector<Side> sides_;
    std::vector<Index> places_;  ///< of sides; with `paired` where the face has two
    Index n_single_ = 0;
};

/// Calls link(half-face, its opposite) once for each face that has two cells, by several threads, and returns
/// the number of those that have one. Throws InputError where a face has more than two, naming them.
template <class VerticesOf, class Link>
Index link_faces(Index n_vertices, Index n_cells, const VerticesOf& vertices_of, const Link& link) {
    const Parts parts(n_vertices, n_cells, vertices_of);
    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::atomic<Index> n_boundary = 0;
    std::atomic<std::size_t> first_bad = none;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, parts.size(), 16), [&](const auto& range) {
        Pairing pairing;
        for (std::size_t p = range.begin(); p != range.end(); ++p) {
            pairing.gather(parts[p], vertices_of);
            if (!pairing.link(link))
                for (std::size_t bad = first_bad; p < bad && !first_bad.compare_exchange_weak(bad, p);) {
                }
            n_boundary += pairing.n_single();
        }
    });
    if (first_bad != none) {
        Pairing pairing;
        pairing.gather(parts[first_bad], vertices_of);
        pairing.fail();
    }
    return n_boundary;
}

}  // namespace maille::volmesh::linking
