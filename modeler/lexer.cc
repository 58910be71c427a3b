#include "modeler/lexer.hh"

#include <charconv>

#include <fmt/format.h>

namespace maille::modeler {

InputError located_error(const std::string& file, Location at, std::string_view message) {
    return InputError(fmt::format("{}:{}:{}: {}", file, at.line, at.column, message));
}

namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$';
}
bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}
/// The second and later bytes of a character in UTF-8 do not count as columns.
bool is_continuation(char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

class Lexer {
  public:
    Lexer(std::string_view text, const std::string& file) : text_(text), file_(file) {
        constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
        if (text_.starts_with(byte_order_mark)) position_ = byte_order_mark.size();
    }

    Token next() {
        skip_blanks();
        if (at_end()) return {.kind = TokenKind::end, .at = at_};
        const char c = peek();
        if (is_letter(c)) return identifier();
        if (is_digit(c) || (c == '.' && is_digit(peek(1)))) return number();
        if (c == '"') return string();
        constexpr std::string_view symbols = "()[]{},;=+-*/%#!";
        if (symbols.find(c) == std::string_view::npos) throw located_error(file_, at_, unexpected());
        const Location start = at_;
        return {.kind = TokenKind::symbol, .text = std::string(1, advance()), .at = start};
    }

  private:
    bool at_end() const { return position_ >= text_.size(); }
    char peek(std::size_t ahead = 0) const {
        return position_ + ahead < text_.size() ? text_[position_ + ahead] : '\0';
    }

    char advance() {
        const char c = text_[position_++];
        if (c == '\n') {
            ++at_.line;
            at_.column = 1;
        } else if (!is_continuation(c)) {
            ++at_.column;
        }
        return c;
    }

    void skip_blanks() {
        while (!at_end()) {
            if (is_space(peek())) {
                advance();
            } else if (peek() == '/' && peek(1) == '/') {
                while (!at_end() && peek() != '\n') advance();
            } else if (peek() == '/' && peek(1) == '*') {
                skip_block_comment();
            } else {
                return;
            }
        }
    }

    void skip_block_comment() {
        const Location start = at_;
        advance();
        advance();
        while (!(peek() == '*' && peek(1) == '/')) {
            if (at_end()) throw located_error(file_, start, "this comment is never closed");
            advance();
        }
        advance();
        advance();
    }

    Token identifier() {
        Token token{.kind = TokenKind::identifier, .at = at_};
        while (is_letter(peek()) || is_digit(peek())) token.text += advance();
        return token;
    }

    Token number() {
        Token token{.kind = TokenKind::number, .at = at_};
        const char* begin = text_.data() + position_;
        const char* end = text_.data() + text_.size();
        const auto [stop, error] = std::from_chars(begin, end, token.number);
        token.text.assign(begin, stop);
        if (error == std::errc::result_out_of_range)
            throw located_error(file_, token.at, fmt::format("the number {} is out of range", token.text));
        for (std::size_t i = 0; i < token.text.size(); ++i) advance();
        if (is_letter(peek()) || peek() == '.')
            throw located_error(file_, token.at, fmt::format("'{}{}' is not a number", token.text, peek()));
        return token;
    }

    Token string() {
        Token token{.kind = TokenKind::string, .at = at_};
        advance();
        while (peek() != '"') {
            if (at_end() || peek() == '\n')
                throw located_error(file_, token.at, "this string is never closed");
            token.text += peek() == '\\' ? escape() : advance();
        }
        advance();
        return token;
    }

    char escape() {
        const Location start = at_;
        advance();
        switch (const char c = peek()) {
            case '"':
            case '\\':
                return advance();
            case 'n':
                advance();
                return '\n';
            case 't':
                advance();
                return '\t';
            default:
                throw located_error(file_, start,
                                    fmt::format("unknown escape '\\{}' in a string", c == '\0' ? ' ' : c));
        }
    }

    std::string unexpected() const {
        const char c = peek();
        const bool printable = c > ' ' && c < '\x7F';
        return printable ? fmt::format("unexpected character '{}'", c)
                         : fmt::format("unexpected byte 0x{:02X}", static_cast<unsigned char>(c));
    }

    std::string_view text_;
    const std::string& file_;
    std::size_t position_ = 0;
    Location at_;
};

}  // namespace

std::vector<Token> tokenize(std::string_view text, const std::string& file) {
    Lexer lexer(text, file);
    std::vector<Token> tokens;
    do tokens.push_back(lexer.next());
    while (tokens.back().kind != TokenKind::end);
    return tokens;
}

}  // namespace maille::modeler
