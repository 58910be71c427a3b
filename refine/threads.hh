#pragma once

#include <algorithm>

#include <tbb/task_arena.h>

#include "volmesh/error.hh"

namespace maille::refine {

/// Calls the action with so many threads at hand, or as many as there are for 0. Throws InputError where the
/// number is negative.
template <class Action>
void with_threads(int threads, const Action& action) {
    if (threads < 0) throw InputError("the number of threads cannot be negative");
    const int available = tbb::this_task_arena::max_concurrency();
    tbb::task_arena arena(threads == 0 ? available : std::min(threads, available));
    arena.execute(action);
}

}  // namespace maille::refine
