#pragma once

#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "modeler/parser.hh"
#include "modeler/primitive.hh"

namespace maille::modeler {

/// The arguments of one node, bound to parameter names and read with their types checked.
/// Every function throws InputError at the place of the argument that does not fit.
class Arguments {
  public:
    /// Positional arguments take the parameters in the order given; an argument of any other name is refused,
    /// but for OpenSCAD's `$fn`, `$fa`, `$fs` and `convexity`, which every node takes.
    Arguments(const Node& node, const std::string& file, std::initializer_list<std::string_view> parameters);

    const Node& node() const { return node_; }
    bool has(std::string_view parameter) const { return find(parameter) != nullptr; }
    bool is_vector(std::string_view parameter) const;

    double number(std::string_view parameter) const;
    double number(std::string_view parameter, double otherwise) const;
    double positive(std::string_view parameter) const;
    double positive(std::string_view parameter, double otherwise) const;
    /// A number without which the node MakesNothing where it is not greater than 0.
    double extent(std::string_view parameter, std::optional<double> otherwise = std::nullopt) const;
    bool boolean(std::string_view parameter, bool otherwise) const;
    /// A whole number of at least `least` and at most `most`.
    int count(std::string_view parameter, int least, int most) const;
    const std::string& text(std::string_view parameter) const;
    /// Three numbers; or two, and then `third` if there is one.
    Point vector(std::string_view parameter, std::optional<double> third = std::nullopt) const;
    const std::vector<Value>& list(std::string_view parameter) const;

    /// A value inside an argument, such as an element of a list; `what` says which it is in messages.
    double number(const Value& value, std::string_view what) const;
    Point vector(const Value& value, std::string_view what, std::optional<double> third = std::nullopt) const;
    const std::vector<Value>& list(const Value& value, std::string_view what) const;

    /// The error "node: message", at the argument if it was given and at the node if it was not.
    InputError error(std::string_view parameter, std::string_view message) const;
    InputError error(Location at, std::string_view message) const;

  private:
    const Value* find(std::string_view parameter) const;
    const Value& get(std::string_view parameter) const;

    const Node& node_;
    const std::string& file_;
    std::map<std::string, const Value*, std::less<>> bound_;
};

/// Calls `make`, and gives the place of the node to an error that knows none.
template <class Make>
auto at_node(const Arguments& arguments, const Make& make) {
    try {
        return make();
    } catch (const InputError& error) {
        throw arguments.error(arguments.node().at, error.what());
    }
}

/// " (did you mean 'cube'?)" where one of the names known is near to `word`, else nothing.
std::string suggestion(std::string_view word, std::span<const std::string_view> known);

}  // namespace maille::modeler
