#include "refine/size_field.hh"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "volmesh/error.hh"

namespace maille::refine {

SizeField::SizeField(double length) {
    if (!(length > 0) || !std::isfinite(length))
        throw InputError(fmt::format("a size must be a positive length, not {}", length));
    source_ =
        std::make_shared<Source>(Source{[length](const Point&) { return length; }, "the constant size"});
}

SizeField::SizeField(std::function<double(const Point&)> function, std::string name)
    : source_(std::make_shared<Source>(Source{std::move(function), std::move(name)})) {}

double SizeField::operator()(const Point& p) const {
    const double size = source_->function(p);
    if (!(size > 0) || !std::isfinite(size))
        throw InputError(fmt::format("{} is {} at ({}, {}, {}); it must be positive and finite everywhere",
                                     source_->name, size, p.x(), p.y(), p.z()));
    return size;
}

SizeField minimum(std::vector<SizeField> fields) {
    return SizeField(
        [fields = std::move(fields)](const Point& p) {
            double least = fields.front()(p);
            for (const SizeField& field : fields) least = std::min(least, field(p));
            return least;
        },
        "the smallest size");
}

}  // namespace maille::refine
