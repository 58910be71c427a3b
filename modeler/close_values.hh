#pragma once

#include <algorithm>
#include <cmath>
#include <span>

namespace maille::modeler {

/// Gives values that differ by no more than the tolerance one value, that nearest to 0, so that what rounding
/// took apart is equal again. Reorders the pointers.
inline void merge_close_values(std::span<double*> values, double tolerance) {
    std::ranges::stable_sort(values, {}, [](const double* value) { return *value; });
    for (std::size_t begin = 0, end = 0; begin < values.size(); begin = end) {
        double common = *values[begin];
        const double last = common + tolerance;
        for (end = begin + 1; end < values.size() && *values[end] <= last; ++end)
            if (std::abs(*values[end]) < std::abs(common)) common = *values[end];
        for (std::size_t k = begin; k < end; ++k) *values[k] = common;
    }
}

}  // namespace maille::modeler
