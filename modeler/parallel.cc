#include "modeler/parallel.hh"

#include <algorithm>
#include <exception>
#include <vector>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace maille::modeler {

void parallel_for(std::size_t n, unsigned threads, const std::function<void(std::size_t)>& f) {
    std::vector<std::exception_ptr> thrown(n);
    const auto guarded = [&](std::size_t i) {
        try {
            f(i);
        } catch (...) {
            thrown[i] = std::current_exception();
        }
    };
    tbb::task_arena arena(static_cast<int>(std::max(threads, 1U)));
    arena.execute([&] { tbb::parallel_for(std::size_t{0}, n, guarded); });
    for (const std::exception_ptr& exception : thrown)
        if (exception) std::rethrow_exception(exception);
}

}  // namespace maille::modeler
