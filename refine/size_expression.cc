#include <numbers>

#include <fmt/format.h>
#include <muParser.h>
#include <tbb/enumerable_thread_specific.h>

#include "refine/size_field.hh"
#include "volmesh/error.hh"

namespace maille::refine {
namespace {

[[noreturn]] void refuse(const std::string& expression, const std::string& reason, int position) {
    const std::string place = position < 0 ? "" : fmt::format(" at character {}", position + 1);
    throw InputError(
        fmt::format("cannot read the size \"{}\": {}{}; write a length or an expression of x, y, z and r, "
                    "such as 0.02+0.2*(1-exp(-r/0.3))",
                    expression, reason, place));
}

/// muParser counts places from 0 within its sentence; ours gives the place in one way for all messages.
std::string plain_words(const mu::ParserError& error) {
    std::string words = error.GetMsg();
    for (const char* tail : {" found at position", " at position", " at expression position"})
        words = words.substr(0, words.find(tail));
    while (!words.empty() && (words.back() == '.' || words.back() == '!')) words.pop_back();
    if (!words.empty()) words[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(words[0])));
    return words;
}

/// A parser is bound to the variables that it reads, so it can neither move nor serve two threads.
class Evaluator {
  public:
    explicit Evaluator(const std::string& expression) {
        parser_.DefineVar("x", &point_.x());
        parser_.DefineVar("y", &point_.y());
        parser_.DefineVar("z", &point_.z());
        parser_.DefineVar("r", &r_);
        parser_.DefineConst("pi", std::numbers::pi);
        parser_.SetExpr(expression);
    }
    Evaluator(const Evaluator&) = delete;
    Evaluator& operator=(const Evaluator&) = delete;

    double operator()(const Point& p) {
        point_ = p;
        r_ = p.norm();
        return parser_.Eval();
    }
    int n_results() const { return parser_.GetNumResults(); }

  private:
    Point point_ = Point::Zero();
    double r_ = 0;
    mu::Parser parser_;
};

/// muParser would take `x=3` for an assignment, which no size needs.
void refuse_assignment(const std::string& expression) {
    for (std::size_t i = 0; i < expression.size(); ++i) {
        if (expression[i] != '=') continue;
        const bool after =
            i > 0 && std::string_view("<>!=").find(expression[i - 1]) != std::string_view::npos;
        const bool before = i + 1 < expression.size() && expression[i + 1] == '=';
        if (!after && !before) refuse(expression, "unexpected \"=\"", static_cast<int>(i));
    }
}

}  // namespace

SizeField parse_size(const std::string& expression) {
    refuse_assignment(expression);
    try {
        Evaluator trial(expression);
        trial(Point::Ones());
        if (trial.n_results() != 1)
            refuse(expression, "it has several parts, separated by commas (a decimal point is a dot)",
                   static_cast<int>(expression.find(',')));
    } catch (const mu::ParserError& error) {
        refuse(expression, plain_words(error), error.GetPos());
    }
    using Evaluators = tbb::enumerable_thread_specific<Evaluator>;
    auto evaluators = std::make_shared<Evaluators>([expression] { return Evaluator(expression); });
    return SizeField([evaluators](const Point& p) { return evaluators->local()(p); },
                     fmt::format("the size \"{}\"", expression));
}

}  // namespace maille::refine
