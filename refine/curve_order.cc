#include "refine/curve_order.hh"

#include <algorithm>
#include <array>
#include <utility>

#include <Eigen/Geometry>
#include <tbb/parallel_for.h>

namespace maille::refine {
namespace {

constexpr int bits = 9;  // of each coordinate, and sorted at a time
constexpr std::uint32_t last_step = (1U << bits) - 1;

/// Two zeros before every bit of a number of at most ten.
std::uint32_t spread(std::uint32_t x) {
    x = (x | (x << 16)) & 0x030000ffU;
    x = (x | (x << 8)) & 0x0300f00fU;
    x = (x | (x << 4)) & 0x030c30c3U;
    return (x | (x << 2)) & 0x09249249U;
}

}  // namespace

CurveOrder::CurveOrder(const TetMesh& mesh) {
    Eigen::AlignedBox3d box;
    for (const volmesh::Point& p : mesh.points()) box.extend(p);
    origin_ = box.isEmpty() ? volmesh::Point(0, 0, 0) : box.min();
    const double size = box.isEmpty() ? 0 : box.sizes().maxCoeff();
    scale_ = size > 0 ? last_step / size : 0;
}

CurveOrder::Place CurveOrder::place(const volmesh::Point& p) const {
    const auto step = [&](int axis) {
        // Vertices may be moved out of the box by a little.
        return static_cast<std::uint32_t>(
            std::clamp((p[axis] - origin_[axis]) * scale_, 0.0, static_cast<double>(last_step)));
    };
    return spread(step(0)) | (spread(step(1)) << 1) | (spread(step(2)) << 2);
}

/// One pass of a radix sort: by some bits of the keys, equals as they were. Many threads count and move parts
/// of the cells, each to the places that the parts before it leave.
void CurveOrder::sort_by_bits(const KeyedCells& from, KeyedCells& to, int shift) {
    constexpr std::size_t n_parts = 32;
    using Counts = std::array<std::uint32_t, last_step + 1>;
    std::vector<Counts> places(n_parts);
    const auto digit = [shift](const Keyed& k) { return (k.place >> shift) & last_step; };
    const auto part = [&](std::size_t i) {
        return std::span(from.begin() + from.size() * i / n_parts,
                         from.begin() + from.size() * (i + 1) / n_parts);
    };
    tbb::parallel_for(std::size_t{0}, n_parts, [&](std::size_t i) {
        places[i].fill(0);
        for (const Keyed& k : part(i)) ++places[i][digit(k)];
    });
    std::uint32_t sum = 0;
    for (std::uint32_t value = 0; value <= last_step; ++value)
        for (Counts& counts : places) sum += std::exchange(counts[value], sum);
    tbb::parallel_for(std::size_t{0}, n_parts, [&](std::size_t i) {
        for (const Keyed& k : part(i)) to[places[i][digit(k)]++] = k;
    });
}

std::span<CurveOrder::Place> CurveOrder::places(std::size_t n_cells) {
    places_.grow(n_cells);
    return {places_.data(), n_cells};
}

std::vector<CellHandle> CurveOrder::sorted(std::span<const CellHandle> cells) {
    keyed_.grow(cells.size() - static_cast<std::size_t>(std::ranges::count(places_, nowhere)));
    other_.grow(keyed_.size());
    std::size_t n = 0;
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (places_[i] != nowhere) keyed_[n++] = {places_[i], cells[i]};
    for (int shift = 0; shift < 3 * bits; shift += bits) {
        sort_by_bits(keyed_, other_, shift);
        keyed_.swap(other_);
    }
    std::vector<CellHandle> result;
    result.reserve(n);
    for (const Keyed& keyed : keyed_) result.push_back(keyed.cell);
    return result;
}

}  // namespace maille::refine
