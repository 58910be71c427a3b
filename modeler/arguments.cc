#include "modeler/arguments.hh"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "modeler/makes_nothing.hh"

namespace maille::modeler {
namespace {

constexpr std::string_view common_parameters[] = {"$fn", "$fa", "$fs", "convexity"};

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i + 1);
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

std::string_view kind(const Value& value) {
    constexpr std::string_view names[] = {"a number", "a boolean", "a string", "a vector", "undef"};
    return names[value.data.index()];
}

InputError not_positive(const Arguments& arguments, std::string_view parameter, double value) {
    return arguments.error(parameter, fmt::format("'{}' must be greater than 0, not {}", parameter, value));
}

}  // namespace

std::string suggestion(std::string_view word, std::span<const std::string_view> known) {
    const auto distance = [&](std::string_view other) { return edit_distance(word, other); };
    const auto nearest = std::ranges::min_element(known, {}, distance);
    if (nearest == known.end() || distance(*nearest) > std::max<std::size_t>(1, nearest->size() / 3))
        return {};
    return fmt::format(" (did you mean '{}'?)", *nearest);
}

Arguments::Arguments(const Node& node, const std::string& file,
                     std::initializer_list<std::string_view> parameters)
    : node_(node), file_(file) {
    std::vector<std::string_view> known(parameters);
    known.insert(known.end(), std::begin(common_parameters), std::end(common_parameters));
    std::size_t next = 0;
    for (const Argument& argument : node.arguments) {
        if (argument.name.empty() && next == parameters.size())
            throw error(argument.at, fmt::format("at most {} arguments without a name", parameters.size()));
        const std::string_view name = argument.name.empty() ? known[next++] : argument.name;
        if (std::ranges::find(known, name) == known.end())
            throw error(argument.at, fmt::format("unknown argument '{}'{}", name, suggestion(name, known)));
        if (!bound_.emplace(name, &argument.value).second)
            throw error(argument.at, fmt::format("'{}' is given twice", name));
    }
}

InputError Arguments::error(Location at, std::string_view message) const {
    return located_error(file_, at, fmt::format("{}: {}", node_.name, message));
}

InputError Arguments::error(std::string_view parameter, std::string_view message) const {
    const Value* value = find(parameter);
    return error(value != nullptr ? value->at : node_.at, message);
}

const Value* Arguments::find(std::string_view parameter) const {
    const auto found = bound_.find(parameter);
    return found == bound_.end() ? nullptr : found->second;
}

const Value& Arguments::get(std::string_view parameter) const {
    if (const Value* value = find(parameter)) return *value;
    throw error(node_.at, fmt::format("'{}' is missing", parameter));
}

bool Arguments::is_vector(std::string_view parameter) const {
    const Value* value = find(parameter);
    return value != nullptr && std::holds_alternative<std::vector<Value>>(value->data);
}

double Arguments::number(std::string_view parameter) const {
    return number(get(parameter), parameter);
}

double Arguments::number(std::string_view parameter, double otherwise) const {
    return has(parameter) ? number(parameter) : otherwise;
}

double Arguments::positive(std::string_view parameter) const {
    const double result = number(parameter);
    if (!(result > 0)) throw not_positive(*this, parameter, result);
    return result;
}

double Arguments::positive(std::string_view parameter, double otherwise) const {
    return has(parameter) ? positive(parameter) : otherwise;
}

double Arguments::extent(std::string_view parameter, std::optional<double> otherwise) const {
    if (otherwise && !has(parameter)) return *otherwise;
    const double result = number(parameter);
    if (!(result > 0)) throw MakesNothing(not_positive(*this, parameter, result));
    return result;
}

bool Arguments::boolean(std::string_view parameter, bool otherwise) const {
    if (!has(parameter)) return otherwise;
    const Value& value = get(parameter);
    if (const bool* result = std::get_if<bool>(&value.data)) return *result;
    throw error(value.at, fmt::format("'{}' must be true or false, not {}", parameter, kind(value)));
}

int Arguments::count(std::string_view parameter, int least, int most) const {
    const double result = number(parameter);
    if (result != std::floor(result) || result < least || result > most)
        throw error(parameter, fmt::format("'{}' must be a whole number from {} to {}, not {}", parameter,
                                           least, most, result));
    return static_cast<int>(result);
}

const std::string& Arguments::text(std::string_view parameter) const {
    const Value& value = get(parameter);
    if (const auto* result = std::get_if<std::string>(&value.data)) return *result;
    throw error(value.at, fmt::format("'{}' must be a string, not {}", parameter, kind(value)));
}

Point Arguments::vector(std::string_view parameter, std::optional<double> third) const {
    return vector(get(parameter), parameter, third);
}

const std::vector<Value>& Arguments::list(std::string_view parameter) const {
    return list(get(parameter), parameter);
}

double Arguments::number(const Value& value, std::string_view what) const {
    const double* result = std::get_if<double>(&value.data);
    if (result == nullptr)
        throw error(value.at, fmt::format("'{}' must be a number, not {}", what, kind(value)));
    if (!std::isfinite(*result))
        throw MakesNothing(error(value.at, fmt::format("'{}' must be finite, not {}", what, *result)));
    return *result;
}

Point Arguments::vector(const Value& value, std::string_view what, std::optional<double> third) const {
    const auto* elements = std::get_if<std::vector<Value>>(&value.data);
    const bool fits = elements != nullptr && (elements->size() == 3 || (elements->size() == 2 && third));
    if (!fits) {
        const std::string found =
            elements != nullptr ? fmt::format("{} elements", elements->size()) : std::string(kind(value));
        throw error(value.at, fmt::format("'{}' must be a vector of 3 numbers, not {}", what, found));
    }
    Point result(0, 0, third.value_or(0));
    for (std::size_t i = 0; i < elements->size(); ++i) result[Eigen::Index(i)] = number((*elements)[i], what);
    return result;
}

const std::vector<Value>& Arguments::list(const Value& value, std::string_view what) const {
    if (const auto* result = std::get_if<std::vector<Value>>(&value.data)) return *result;
    throw error(value.at, fmt::format("'{}' must be a list in brackets, not {}", what, kind(value)));
}

}  // namespace maille::modeler
