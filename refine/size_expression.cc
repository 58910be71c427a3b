#include <numbers>

#include <fmt/format.h>
#include <muParser.h>
#include <tbb/enumerable_thread_specific.h>

#include "refine/size_calls.hh"
#include "refine/size_field.hh"
#include "volmesh/error.hh"

namespace maille::refine {
namespace {

using Function = std::function<double(const Point&)>;

/// A part of an expression that stands, for the parser, as a variable in its place.
struct Term {
    SizeCall call;
    std::string variable;
    Function value;
};

/// An expression as muParser reads it: calls of what it doesn't know have become variables, padded with
/// blanks so that all else stays in its place.
struct Expression {
    std::string original, plain;
    std::vector<Term> terms;
};

Expression with_variables(const std::string& expression) {
    Expression result{expression, expression, {}};
    for (SizeCall& call : find_calls(expression)) {
        const std::size_t length = call.end - call.begin;
        std::string variable = fmt::format("_{}", result.terms.size());
        result.plain.replace(call.begin, length, variable + std::string(length - variable.size(), ' '));
        result.terms.push_back({std::move(call), std::move(variable), {}});
    }
    return result;
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

/// muParser's words with the calls as they were written.
std::string reason(const Expression& expression, const mu::ParserError& error) {
    std::string words = plain_words(error);
    for (const auto& [call, variable, value] : expression.terms) {
        const std::size_t at = words.find('"' + variable + '"');
        if (at == std::string::npos) continue;
        words.replace(at + 1, variable.size(), expression.original.substr(call.begin, call.end - call.begin));
    }
    return words;
}

/// A parser is bound to the variables that it reads, so it can neither move nor serve two threads.
class Evaluator {
  public:
    explicit Evaluator(const Expression& expression)
        : terms_(expression.terms), values_(expression.terms.size(), 1) {
        parser_.DefineVar("x", &point_.x());
        parser_.DefineVar("y", &point_.y());
        parser_.DefineVar("z", &point_.z());
        parser_.DefineVar("r", &r_);
        parser_.DefineConst("pi", std::numbers::pi);
        for (std::size_t i = 0; i < terms_.size(); ++i) parser_.DefineVar(terms_[i].variable, &values_[i]);
        parser_.SetExpr(expression.plain);
    }
    Evaluator(const Evaluator&) = delete;
    Evaluator& operator=(const Evaluator&) = delete;

    /// Terms that have no function yet count as 1.
    double operator()(const Point& p) {
        point_ = p;
        r_ = p.norm();
        for (std::size_t i = 0; i < terms_.size(); ++i)
            if (terms_[i].value) values_[i] = terms_[i].value(p);
        return parser_.Eval();
    }
    int n_results() const { return parser_.GetNumResults(); }

  private:
    Point point_ = Point::Zero();
    double r_ = 0;
    std::vector<Term> terms_;
    std::vector<double> values_;
    mu::Parser parser_;
};

/// muParser would take `x=3` for an assignment, which no size needs.
void refuse_assignment(const std::string& expression) {
    for (std::size_t i = 0; i < expression.size(); ++i) {
        if (expression[i] != '=') continue;
        const bool after =
            i > 0 && std::string_view("<>!=").find(expression[i - 1]) != std::string_view::npos;
        const bool before = i + 1 < expression.size() && expression[i + 1] == '=';
        if (!after && !before) refuse_expression(expression, "unexpected \"=\"", static_cast<int>(i));
    }
}

/// The expression, read as far as it can be without sets and surfaces.
Expression read(const std::string& text) {
    Expression expression = with_variables(text);
    refuse_assignment(expression.plain);
    try {
        Evaluator trial(expression);
        trial(Point::Ones());
        if (trial.n_results() != 1)
            refuse_expression(text, "it has several parts, separated by commas (a decimal point is a dot)",
                              static_cast<int>(expression.plain.find(',')));
    } catch (const mu::ParserError& error) {
        refuse_expression(text, reason(expression, error), error.GetPos());
    }
    return expression;
}

Function value_of(const SizeCall& call, const SizeContext& context) {
    if (call.function == SizeCall::Function::set_distance) {
        if (context.mesh == nullptr)
            throw InputError(fmt::format("d('{}') takes a mesh: there is none here yet", call.set_name));
        return set_distance(*context.mesh, call.set_name);
    }
    if (context.mesh == nullptr || context.projector == nullptr)
        throw InputError(fmt::format("curvature({}) takes a mesh and its model: {} here", call.segments,
                                     context.mesh == nullptr ? "there is no mesh yet" : "there is no model"));
    return curvature_size(*context.mesh, *context.projector, call.segments);
}

}  // namespace

void check_size(const std::string& expression) {
    read(expression);
}

SizeField parse_size(const std::string& text, const SizeContext& context) {
    Expression expression = read(text);
    for (Term& term : expression.terms) term.value = value_of(term.call, context);
    using Evaluators = tbb::enumerable_thread_specific<Evaluator>;
    auto evaluators = std::make_shared<Evaluators>([expression] { return Evaluator(expression); });
    return SizeField([evaluators](const Point& p) { return evaluators->local()(p); },
                     fmt::format("the size \"{}\"", text));
}

}  // namespace maille::refine
