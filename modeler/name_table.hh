#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

namespace maille::modeler {

/// A word of a language, and what it means.
template <class Value>
using NameRow = std::pair<std::string_view, Value>;

/// What the name means; a value that counts as false (a null pointer, an empty optional) where the table does
/// not have it.
template <class Value, std::size_t n>
Value look_up(const NameRow<Value> (&table)[n], std::string_view name) {
    const auto entry = std::ranges::find(table, name, [](const auto& row) { return row.first; });
    return entry == std::end(table) ? Value{} : entry->second;
}

/// In the order of the table.
template <class Value, std::size_t n>
std::vector<std::string_view> names_of(const NameRow<Value> (&table)[n]) {
    std::vector<std::string_view> names;
    for (const auto& row : table) names.push_back(row.first);
    return names;
}

}  // namespace maille::modeler
