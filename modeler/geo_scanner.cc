#include "modeler/geo_scanner.hh"

#include <cmath>

#include <fmt/format.h>

namespace maille::modeler {
namespace {

std::string without_comments(std::string_view text) {
    std::string result(text);
    bool in_comment = false;
    for (char& c : result) {
        if (c == '#') in_comment = true;
        if (c == '\n') in_comment = false;
        if (in_comment) c = ' ';
    }
    return result;
}

}  // namespace

GeoScanner::GeoScanner(std::string_view text, const std::string& file)
    : file_(file), tokens_(tokenize(without_comments(text), file)) {}

bool GeoScanner::accept(char symbol) {
    if (!is(symbol)) return false;
    ++position_;
    return true;
}

bool GeoScanner::accept(std::string_view word) {
    if (!is(word)) return false;
    ++position_;
    return true;
}

void GeoScanner::expect(char symbol) {
    if (!accept(symbol)) throw expected(fmt::format("'{}'", symbol));
}

InputError GeoScanner::expected(std::string_view what) const {
    const std::string found = at_end() ? "the end of the file" : fmt::format("'{}'", current().text);
    return error(fmt::format("expected {} but found {}", what, found));
}

std::string GeoScanner::word(std::string_view what) {
    if (current().kind != TokenKind::identifier) throw expected(what);
    return tokens_[position_++].text;
}

double GeoScanner::number() {
    bool negative = false;
    while (accept('-')) negative = !negative;
    if (current().kind != TokenKind::number) throw expected("a number");
    const double value = tokens_[position_++].number;
    return negative ? -value : value;
}

int GeoScanner::count(int least, int most) {
    const Location at = current().at;
    const double value = number();
    if (value != std::floor(value) || value < least || value > most)
        throw error(at, fmt::format("expected a whole number from {} to {}, not {}", least, most, value));
    return static_cast<int>(value);
}

Eigen::Vector3d GeoScanner::vector() {
    Eigen::Vector3d result;
    for (int i = 0; i < 3; ++i) {
        if (i > 0) expect(',');
        result[i] = number();
    }
    return result;
}

}  // namespace maille::modeler
