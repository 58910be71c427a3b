#include "modeler/language_resize.hh"

#include <array>

#include "modeler/arguments.hh"

namespace maille::modeler {
namespace {

/// `auto`: one truth for all directions, or three; OpenSCAD writes them as 0 and 1.
std::array<bool, 3> read_auto(const Arguments& arguments) {
    if (!arguments.is_vector("auto")) {
        const bool all = arguments.boolean("auto", false);
        return {all, all, all};
    }
    std::array<bool, 3> result{};
    const auto& values = arguments.list("auto");
    if (values.size() > 3) throw arguments.error("auto", "'auto' must be at most three truths");
    for (std::size_t i = 0; i < values.size(); ++i) {
        const bool* truth = std::get_if<bool>(&values[i].data);
        result[i] = truth != nullptr ? *truth : arguments.number(values[i], "auto") != 0;
    }
    return result;
}

}  // namespace

Point resize_factors(const Node& node, const std::string& file, const Eigen::AlignedBox3d& box) {
    const Arguments arguments(node, file, {"newsize", "auto"});
    const Point wanted = arguments.vector("newsize", 0);
    if (!(wanted.minCoeff() >= 0)) throw arguments.error("newsize", "a size must not be negative");
    const std::array<bool, 3> by_largest = read_auto(arguments);
    const Point present = box.sizes();
    Eigen::Index largest = 0;
    for (Eigen::Index i = 1; i < 3; ++i)
        if (present[i] > 0 && wanted[i] > wanted[largest]) largest = i;
    Point factors = Point::Ones();
    for (Eigen::Index i = 0; i < 3; ++i) {
        if (!(present[i] > 0)) continue;
        if (wanted[i] > 0)
            factors[i] = wanted[i] / present[i];
        else if (by_largest[static_cast<std::size_t>(i)] && wanted[largest] > 0)
            factors[i] = wanted[largest] / present[largest];
    }
    return factors;
}

}  // namespace maille::modeler
