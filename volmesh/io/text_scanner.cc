#include "volmesh/io/text_scanner.hh"

#include <cmath>
#include <cstdlib>

#include <fmt/core.h>

namespace maille::volmesh::io {

void TextScanner::skip_comment() {
    const auto* newline = static_cast<const char*>(std::memchr(at_, '\n', n_left()));
    at_ = newline ? newline : end_;
}

void TextScanner::skip_blanks() {
    for (; at_ != end_; ++at_) {
        if (is_comment(*at_)) skip_comment();
        if (at_ == end_ || !is_blank(*at_)) return;
    }
}

bool TextScanner::at_end() {
    skip_blanks();
    return at_ == end_;
}

bool TextScanner::at_end_of_line() {
    while (at_ != end_ && *at_ != '\n' && is_blank(*at_)) ++at_;
    return at_ == end_ || *at_ == '\n' || is_comment(*at_);
}

std::string_view TextScanner::word(const char* what) {
    if (at_end()) fail(fmt::format("the file ends where {} should be", what));
    const char* begin = at_;
    while (at_ != end_ && !is_blank(*at_) && !is_comment(*at_)) ++at_;
    return {begin, static_cast<std::size_t>(at_ - begin)};
}

std::string_view TextScanner::line() {
    const char* begin = at_;
    skip_comment();
    std::string_view text(begin, static_cast<std::size_t>(at_ - begin));
    if (at_ != end_) ++at_;
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

const char* TextScanner::number_begin(const char* what) {
    if (at_end()) fail(fmt::format("the file ends where {} should be", what));
    return *at_ == '+' ? at_ + 1 : at_;
}

void TextScanner::end_number(const char* begin, const char* end, std::errc error, const char* what) {
    const bool is_whole = end == end_ || is_blank(*end) || is_comment(*end);
    if (error != std::errc{} || end == begin || !is_whole) fail_number(what);
    at_ = end;
}

void TextScanner::fail_number(const char* what) const {
    const char* end = at_;
    while (end != end_ && !is_blank(*end) && end - at_ < 40) ++end;
    fail(fmt::format("'{}' stands where {} should be",
                     std::string_view(at_, static_cast<std::size_t>(end - at_)), what));
}

double TextScanner::real(const char* what) {
    const char* begin = number_begin(what);
    double value{};
    auto [end, error] = std::from_chars(begin, end_, value);
    if (error == std::errc::result_out_of_range) {  // too small: 0 or nearly; too large: infinite
        value = std::strtod(std::string(begin, end).c_str(), nullptr);
        error = {};
    }
    end_number(begin, end, error, what);
    return value;
}

double TextScanner::coordinate() {
    const double value = real("a coordinate");
    if (!std::isfinite(value)) fail("a coordinate is not a finite number");
    return value;
}

Eigen::Vector3d TextScanner::point() {
    Eigen::Vector3d p;
    for (double& x : p) x = coordinate();
    return p;
}

std::size_t TextScanner::checked(std::size_t count, const char* what, std::size_t bytes_each) const {
    if (count > n_left() / bytes_each)
        fail(fmt::format("{} is said to be {}, more than the rest of the file can hold", what, count));
    return count;
}

std::string_view TextScanner::bytes(std::size_t n) {
    if (n > n_left()) fail("the file ends too early");
    at_ += n;
    return {at_ - n, n};
}

}  // namespace maille::volmesh::io
