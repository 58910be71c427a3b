#include "refine/size_calls.hh"

#include <cctype>
#include <charconv>

#include <fmt/format.h>

#include "volmesh/error.hh"

namespace maille::refine {
namespace {

bool is_name_character(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
}

/// Reads calls from the text of an expression, from left to right.
class CallReader {
  public:
    explicit CallReader(const std::string& text) : text_(text) {}

    std::vector<SizeCall> all() {
        std::vector<SizeCall> calls;
        while (at_ < text_.size()) {
            const std::size_t begin = at_;
            const std::string name = word();
            skip_blanks();
            if ((name == "d" || name == "curvature") && at_ < text_.size() && text_[at_] == '(') {
                ++at_;
                SizeCall call = name == "d" ? set_distance() : curvature();
                call.begin = begin;
                call.end = at_;
                calls.push_back(std::move(call));
            } else if (name.empty() && at_ == begin) {
                ++at_;
            }
        }
        return calls;
    }

  private:
    [[noreturn]] void refuse(const std::string& reason, std::size_t at) const {
        refuse_expression(text_, reason, static_cast<int>(at));
    }

    std::string word() {
        const std::size_t begin = at_;
        while (at_ < text_.size() && is_name_character(text_[at_])) ++at_;
        return text_.substr(begin, at_ - begin);
    }

    void skip_blanks() {
        while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    }

    void close(const std::string& function) {
        skip_blanks();
        if (at_ >= text_.size() || text_[at_] != ')')
            refuse(fmt::format("{} lacks its \")\"", function), at_);
        ++at_;
    }

    SizeCall set_distance() {
        skip_blanks();
        const char quote = at_ < text_.size() ? text_[at_] : ' ';
        const std::size_t end = text_.find(quote, at_ + 1);
        if ((quote != '\'' && quote != '"') || end == std::string::npos)
            refuse("d takes the name of a set in quotes, such as d('hole/side')", at_);
        SizeCall call{.function = SizeCall::Function::set_distance,
                      .set_name = text_.substr(at_ + 1, end - at_ - 1)};
        at_ = end + 1;
        close("d");
        return call;
    }

    SizeCall curvature() {
        skip_blanks();
        SizeCall call{.function = SizeCall::Function::curvature};
        const auto [end, error] =
            std::from_chars(text_.data() + at_, text_.data() + text_.size(), call.segments);
        if (error != std::errc() || !(call.segments >= 3))
            refuse("curvature takes a number of segments to the circle, at least 3, such as curvature(20)",
                   at_);
        at_ = static_cast<std::size_t>(end - text_.data());
        close("curvature");
        return call;
    }

    const std::string& text_;
    std::size_t at_ = 0;
};

}  // namespace

void refuse_expression(const std::string& expression, const std::string& reason, int position) {
    const std::string place = position < 0 ? "" : fmt::format(" at character {}", position + 1);
    throw InputError(
        fmt::format("cannot read the size \"{}\": {}{}; write a length or an expression of x, y, z and r, "
                    "such as 0.02+0.2*(1-exp(-r/0.3))",
                    expression, reason, place));
}

std::vector<SizeCall> find_calls(const std::string& expression) {
    return CallReader(expression).all();
}

}  // namespace maille::refine
