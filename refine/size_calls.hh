#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace maille::refine {

/// Throws InputError: the expression of a size can't be read, for this reason, at this place (from 0;
/// negative if it has none).
[[noreturn]] void refuse_expression(const std::string& expression, const std::string& reason, int position);

/// A call, in the expression of a size, of what an expression parser knows nothing of.
struct SizeCall {
    enum class Function : std::uint8_t { set_distance, curvature };

    Function function;
    std::string set_name{};          ///< of set_distance
    double segments = 0;             ///< of curvature
    std::size_t begin = 0, end = 0;  ///< where it stands
};

/// All calls `d('set')` and `curvature(number)`, in order. Throws InputError where one is miswritten.
std::vector<SizeCall> find_calls(const std::string& expression);

}  // namespace maille::refine
