#include "modeler/parser.hh"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>

namespace maille::modeler {
namespace {

std::string describe(const Token& token) {
    if (token.kind == TokenKind::end) return "the end of the file";
    if (token.kind == TokenKind::string) return fmt::format("the string \"{}\"", token.text);
    return fmt::format("'{}'", token.text);
}

/// Recursive descent over the tokens of one file.
class Parser {
  public:
    Parser(std::string_view text, const std::string& file) : tokens_(tokenize(text, file)), file_(file) {}

    std::vector<Node> file() {
        std::vector<Node> nodes;
        while (current().kind != TokenKind::end) statement_into(nodes);
        return nodes;
    }

  private:
    /// Counts the nesting for as long as it lives.
    class Nesting {
      public:
        explicit Nesting(Parser& parser) : parser_(parser) {
            if (++parser_.depth_ > max_nesting)
                throw parser_.error(fmt::format("nested deeper than {} levels", max_nesting));
        }
        ~Nesting() { --parser_.depth_; }
        Nesting(const Nesting&) = delete;
        Nesting& operator=(const Nesting&) = delete;

      private:
        Parser& parser_;
    };

    const Token& current() const { return tokens_[position_]; }
    const Token& after_current() const { return tokens_[std::min(position_ + 1, tokens_.size() - 1)]; }
    bool is_symbol(char c) const { return is_symbol(current(), c); }
    static bool is_symbol(const Token& token, char c) {
        return token.kind == TokenKind::symbol && token.text[0] == c;
    }

    InputError error(std::string_view message) const { return located_error(file_, current().at, message); }
    InputError expected(std::string_view what) const {
        return error(fmt::format("expected {} but found {}", what, describe(current())));
    }

    bool accept(char c) {
        if (!is_symbol(c)) return false;
        ++position_;
        return true;
    }
    void expect(char c) {
        if (!accept(c)) throw expected(fmt::format("'{}'", c));
    }

    void statement_into(std::vector<Node>& nodes) {
        if (!accept(';')) nodes.push_back(node());
    }

    Node node() {
        const Nesting nesting(*this);
        Node result;
        while (is_symbol('%') || is_symbol('*') || is_symbol('#') || is_symbol('!')) {
            result.ignored |= is_symbol('%') || is_symbol('*');
            result.disabled |= is_symbol('*');
            result.is_root |= is_symbol('!');
            ++position_;
        }
        if (current().kind != TokenKind::identifier) throw expected("a node");
        result.name = current().text;
        result.at = current().at;
        ++position_;
        if (is_symbol('='))
            throw located_error(
                file_, result.at,
                fmt::format("there are no variables: write the value of '{}' where it is used, or have "
                            "OpenSCAD write the .csg file",
                            result.name));
        result.arguments = arguments();
        if (accept('{')) {
            while (!accept('}')) {
                if (current().kind == TokenKind::end) throw expected("'}'");
                statement_into(result.children);
            }
        } else if (!accept(';')) {
            if (current().kind == TokenKind::end || is_symbol('}')) throw expected("';'");
            result.children.push_back(node());
        }
        return result;
    }

    std::vector<Argument> arguments() {
        std::vector<Argument> result;
        expect('(');
        while (!accept(')')) {
            result.push_back(argument());
            if (!is_symbol(')') && !accept(',')) throw expected("',' or ')'");
        }
        return result;
    }

    Argument argument() {
        Argument result{.name = {}, .value = {}, .at = current().at};
        if (current().kind == TokenKind::identifier && is_symbol(after_current(), '=')) {
            result.name = current().text;
            position_ += 2;
        }
        result.value = sum();
        return result;
    }

    Value sum() {
        Value left = product();
        while (is_symbol('+') || is_symbol('-')) left = operation(std::move(left), &Parser::product);
        return left;
    }

    Value product() {
        Value left = signed_value();
        while (is_symbol('*') || is_symbol('/')) left = operation(std::move(left), &Parser::signed_value);
        return left;
    }

    Value operation(Value left, Value (Parser::*operand)()) {
        const Token symbol = current();
        ++position_;
        const double a = number(left);
        const double b = number((this->*operand)());
        const char c = symbol.text[0];
        const double result = c == '+' ? a + b : c == '-' ? a - b : c == '*' ? a * b : a / b;
        if (!std::isfinite(result))
            throw located_error(file_, symbol.at, fmt::format("{} {} {} has no finite value", a, c, b));
        return {.data = result, .at = left.at};
    }

    Value signed_value() {
        const Nesting nesting(*this);
        const Location start = current().at;
        if (accept('-')) return {.data = -number(signed_value()), .at = start};
        if (accept('+')) return {.data = number(signed_value()), .at = start};
        return plain_value();
    }

    double number(const Value& value) const {
        if (const double* number = std::get_if<double>(&value.data)) return *number;
        throw located_error(file_, value.at, "arithmetic is for numbers only");
    }

    Value plain_value() {
        const Token token = current();
        if (is_symbol('[')) return vector();
        if (accept('(')) {
            Value inner = sum();
            expect(')');
            return {.data = std::move(inner.data), .at = token.at};
        }
        switch (token.kind) {
            case TokenKind::number:
                ++position_;
                return {.data = token.number, .at = token.at};
            case TokenKind::string:
                ++position_;
                return {.data = token.text, .at = token.at};
            case TokenKind::identifier:
                ++position_;
                return named_constant(token);
            default:
                throw expected("a value");
        }
    }

    Value named_constant(const Token& token) const {
        if (token.text == "true" || token.text == "false")
            return {.data = token.text == "true", .at = token.at};
        if (token.text == "undef") return {.data = std::monostate{}, .at = token.at};
        // OpenSCAD writes what it divided by 0.
        if (token.text == "inf") return {.data = std::numeric_limits<double>::infinity(), .at = token.at};
        if (token.text == "nan") return {.data = std::numeric_limits<double>::quiet_NaN(), .at = token.at};
        if (token.text == "pi" || token.text == "PI") return {.data = std::numbers::pi, .at = token.at};
        throw located_error(
            file_, token.at,
            fmt::format("unknown value '{}': there are numbers, strings, vectors, true, false and pi",
                        token.text));
    }

    Value vector() {
        Value result{.data = std::vector<Value>{}, .at = current().at};
        auto& elements = std::get<std::vector<Value>>(result.data);
        expect('[');
        while (!accept(']')) {
            elements.push_back(sum());
            if (!is_symbol(']') && !accept(',')) throw expected("',' or ']'");
        }
        return result;
    }

    std::vector<Token> tokens_;
    const std::string& file_;
    std::size_t position_ = 0;
    int depth_ = 0;
};

}  // namespace

std::vector<Node> parse(std::string_view text, const std::string& file) {
    return Parser(text, file).file();
}

}  // namespace maille::modeler
