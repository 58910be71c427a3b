#pragma once

#include <string>

#include "tools/benchmark/start_mesh.hh"

namespace maille::benchmark {

enum class Work {
    local,       ///< to 0.0008 + 0.05 (1 - exp(-r)), r from the origin, as a C++ function
    expression,  ///< the same as a text
    uniform,     ///< to one size
    eighths      ///< every element into eight, level by level
};

struct RefinementCase {
    std::string name;  ///< what the row is called
    Work work = Work::local;
    double scale = 1;  ///< of the sizes of local work
    double size = 0;   ///< of uniform work
    int levels = 2;    ///< of work by eighths
    bool with_parts = true;
    bool check = false;  ///< validate the result
    int threads = 1;
    int repeats = 3;
};

/// Refines the mesh again and again and prints a row of figures, each the median of the repeats; throws
/// std::runtime_error where a result is not valid or differs from the one before.
void run(const CellSoup& soup, const RefinementCase& what);
void print_refinement_header();

}  // namespace maille::benchmark
