#pragma once

#include <cstddef>
#include <functional>

namespace maille::modeler {

/// Calls f(0) to f(n-1), up to `threads` of them at once. Throws what the call with the lowest number threw.
void parallel_for(std::size_t n, unsigned threads, const std::function<void(std::size_t)>& f);

}  // namespace maille::modeler
