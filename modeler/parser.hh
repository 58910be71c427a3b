#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "modeler/lexer.hh"

namespace maille::modeler {

/// A value of the model language: what an argument was written as.
struct Value {
    std::variant<double, bool, std::string, std::vector<Value>, std::monostate> data;  ///< monostate: undef
    Location at{};
};

struct Argument {
    std::string name;  ///< empty where it is positional
    Value value;
    Location at{};
};

/// `name(arguments) { children }`, before it is known what the name means.
struct Node {
    std::string name;
    Location at{};
    bool ignored = false;   ///< marked with `%` or `*`
    bool disabled = false;  ///< marked with `*`: a root in it does not count either
    bool is_root = false;   ///< marked with `!`: the model is this node alone
    std::vector<Argument> arguments{};
    std::vector<Node> children{};
};

/// Nodes and expressions may be nested this deep.
inline constexpr int max_nesting = 1000;

/// The nodes at the top level of a model file. Arithmetic is carried out.
/// Throws InputError with file, line and column where the text breaks the grammar.
std::vector<Node> parse(std::string_view text, const std::string& file);

}  // namespace maille::modeler
