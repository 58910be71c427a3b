#pragma once

#include <exception>
#include <span>
#include <vector>

#include "modeler/parser.hh"
#include "volmesh/error.hh"

namespace maille::modeler {

/// Thrown by nodes that OpenSCAD makes nothing of, such as a cube without thickness: a model may hold them,
/// but not consist of them.
class MakesNothing : public InputError {
  public:
    explicit MakesNothing(const InputError& reason) : InputError(reason) {}
};

/// What `make` makes of each node that isn't ignored: a default value where it makes nothing. Where none of
/// them makes anything, for a reason, neither do all together: then it throws the first reason.
template <class Make>
auto made_of(std::span<const Node> nodes, const Make& make) {
    std::vector<decltype(make(nodes.front()))> made;
    std::exception_ptr reason;
    bool all_nothing = true;
    for (const Node& node : nodes) {
        if (node.ignored) continue;
        try {
            made.push_back(make(node));
            all_nothing = false;
        } catch (const MakesNothing&) {
            made.emplace_back();
            if (!reason) reason = std::current_exception();
        }
    }
    if (reason && all_nothing) std::rethrow_exception(reason);
    return made;
}

}  // namespace maille::modeler
