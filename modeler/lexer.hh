#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "volmesh/error.hh"

namespace maille::modeler {

/// A place in a model file; lines and columns count from 1, columns in characters.
struct Location {
    std::uint32_t line = 1;
    std::uint32_t column = 1;
};

/// The error "file:line:column: message", as every message of the model language is.
InputError located_error(const std::string& file, Location at, std::string_view message);

enum class TokenKind : std::uint8_t { identifier, number, string, symbol, end };

struct Token {
    TokenKind kind = TokenKind::end;
    std::string text{};  ///< as written; of a string its contents, with the escapes resolved
    double number = 0;   ///< number only
    Location at{};
};

/// Splits a model file into tokens, the last of which is `end`. Comments and white space are skipped.
/// Throws InputError on a character, number, string or comment that is none of the language's.
std::vector<Token> tokenize(std::string_view text, const std::string& file);

}  // namespace maille::modeler
