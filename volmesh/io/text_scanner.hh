#pragma once

#include <charconv>
#include <concepts>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include "volmesh/io/input_file.hh"

namespace maille::volmesh::io {

/// Reads a file from front to back, word by word, line by line or in raw bytes. Every failure is an
/// InputError that names the file and the line.
class TextScanner {
  public:
    /// From the comment sign to the end of its line the text is skipped.
    explicit TextScanner(const InputFile& file, std::optional<char> comment_sign = std::nullopt)
        : file_(file), at_(file.text().data()), end_(at_ + file.text().size()), comment_sign_(comment_sign) {}

    /// Only blanks and comments are left.
    bool at_end();
    /// The next word; `what` says in the message what was expected where there is none.
    std::string_view word(const char* what);
    /// The rest of the line, without blanks at its ends.
    std::string_view line();
    /// The words left on this line, none on an empty one.
    bool at_end_of_line();

    template <std::integral T>
    T integer(const char* what);
    double real(const char* what);
    /// A finite number.
    double coordinate();
    /// Three of them.
    Eigen::Vector3d point();
    /// A number of items, each of at least that many bytes, that the rest of the file can hold.
    std::size_t count(const char* what, std::size_t bytes_each = 2) {
        return checked(integer<std::size_t>(what), what, bytes_each);
    }
    std::size_t checked(std::size_t count, const char* what, std::size_t bytes_each) const;

    /// Raw bytes from the present place on.
    std::string_view bytes(std::size_t n);
    std::size_t n_left() const { return static_cast<std::size_t>(end_ - at_); }
    std::string_view rest() const { return {at_, n_left()}; }

    [[noreturn]] void fail(const std::string& message) const { file_.fail_at_line(at_, message); }

  private:
    static bool is_blank(char c) {
        return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
    }
    bool is_comment(char c) const { return comment_sign_ && c == *comment_sign_; }
    void skip_blanks();
    void skip_comment();
    /// Where the next number begins.
    const char* number_begin(const char* what);
    void end_number(const char* begin, const char* end, std::errc error, const char* what);
    [[noreturn]] void fail_number(const char* what) const;

    const InputFile& file_;
    const char* at_;
    const char* end_;
    std::optional<char> comment_sign_;
};

template <std::integral T>
T TextScanner::integer(const char* what) {
    const char* begin = number_begin(what);
    T value{};
    const auto [end, error] = std::from_chars(begin, end_, value);
    end_number(begin, end, error, what);
    return value;
}

}  // namespace maille::volmesh::io
