#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace maille::modeler {

/// The vertices of a triangle.
using Triple = std::array<std::uint32_t, 3>;

inline Triple sorted(Triple t) {
    std::ranges::sort(t);
    return t;
}

/// Whether two triples of the same vertices turn the same way.
inline bool same_turn(const Triple& a, const Triple& b) {
    return (a[0] == b[0] && a[1] == b[1]) || (a[0] == b[1] && a[1] == b[2]) || (a[0] == b[2] && a[1] == b[0]);
}

struct TripleHash {
    std::size_t operator()(const Triple& t) const {
        std::uint64_t hash = 0;
        for (std::uint32_t v : t) hash = (hash ^ v) * 0x9e3779b97f4a7c15ULL, hash ^= hash >> 29;
        return hash;
    }
};

}  // namespace maille::modeler
