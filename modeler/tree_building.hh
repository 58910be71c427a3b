#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "modeler/model.hh"

namespace maille::modeler {

/// Whether the tree is a union of nothing, which is how this language writes the empty solid.
bool is_empty(const CsgTree& tree);

/// The operation on its children, as simple as it gets: nothing empty stays inside, unions within unions
/// become one, and an operation on a single child is that child.
CsgTree combine(Operation operation, std::vector<CsgTree> children);

/// A leaf that makes the solid reach to infinity, where `is_unbounded` says which primitives do; nothing if
/// none does.
std::optional<std::uint32_t> unbounded_leaf(const CsgTree& tree,
                                            const std::function<bool(std::uint32_t)>& is_unbounded);

/// Removes the primitives that no leaf names; the others keep their order.
void drop_unused_primitives(Model& model);

}  // namespace maille::modeler
