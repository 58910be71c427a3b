#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "modeler/lexer.hh"

namespace maille::modeler {

/// Walks over the tokens of a .geo file, in which comments run from # to the end of the line.
class GeoScanner {
  public:
    GeoScanner(std::string_view text, const std::string& file);

    const Token& current() const { return tokens_[position_]; }
    bool at_end() const { return current().kind == TokenKind::end; }
    bool is(char symbol) const { return current().kind == TokenKind::symbol && current().text[0] == symbol; }
    bool is(std::string_view word) const {
        return current().kind == TokenKind::identifier && current().text == word;
    }

    bool accept(char symbol);
    bool accept(std::string_view word);
    void expect(char symbol);
    std::string word(std::string_view what);
    double number();
    /// A whole number from `least` to `most`.
    int count(int least, int most);
    /// Numbers between commas.
    Eigen::Vector3d vector();

    InputError error(std::string_view message) const { return located_error(file_, current().at, message); }
    InputError error(Location at, std::string_view message) const {
        return located_error(file_, at, message);
    }
    InputError expected(std::string_view what) const;

  private:
    const std::string& file_;
    std::vector<Token> tokens_;
    std::size_t position_ = 0;
};

}  // namespace maille::modeler
