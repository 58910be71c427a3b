#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <tbb/parallel_for.h>

namespace maille::quality {

/// What `find(i, found)` appends to `found` for each i below n, by as many threads as there are, sorted by
/// `Candidate::order`.
template <class Candidate, class Find>
std::vector<Candidate> sorted_candidates(std::uint32_t n, const Find& find) {
    constexpr std::uint32_t block = 512;
    std::vector<std::vector<Candidate>> found((n + block - 1) / block);
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t b) {
        const auto begin = static_cast<std::uint32_t>(b) * block;
        const std::uint32_t end = std::min(begin + block, n);
        for (std::uint32_t i = begin; i < end; ++i) find(i, found[b]);
    });
    std::vector<Candidate> all;
    for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
    std::ranges::sort(all, {}, &Candidate::order);
    return all;
}

}  // namespace maille::quality
