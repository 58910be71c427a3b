#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

/// How the lines of Abaqus' input files are made up.
namespace maille::volmesh::io::abaqus {

inline std::string_view trimmed(std::string_view text) {
    const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

inline std::string upper(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(), [](unsigned char c) { return std::toupper(c); });
    return result;
}

inline std::vector<std::string_view> split_at_commas(std::string_view line) {
    std::vector<std::string_view> items;
    for (;;) {
        const std::size_t comma = line.find(',');
        items.push_back(trimmed(line.substr(0, comma)));
        if (comma == std::string_view::npos) break;
        line.remove_prefix(comma + 1);
    }
    if (items.back().empty()) items.pop_back();  // a comma at the end of a line
    return items;
}

inline std::string_view without_quotes(std::string_view label) {
    const bool is_quoted = label.size() >= 2 && label.front() == '"' && label.back() == '"';
    return is_quoted ? label.substr(1, label.size() - 2) : label;
}

/// A label as it is compared.
inline std::string key_of(std::string_view label) {
    return upper(without_quotes(label));
}

}  // namespace maille::volmesh::io::abaqus
