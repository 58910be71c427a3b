#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <vector>

namespace maille::modeler {

/// What is done with the children; a leaf is a primitive.
enum class Operation : std::uint8_t { leaf, join, intersection, difference, fragment };

/// A boolean expression over numbered primitives. `join` is the union.
struct CsgTree {
    Operation operation = Operation::join;  ///< of all children
    std::uint32_t primitive = 0;            ///< leaf only
    std::vector<CsgTree> children{};        ///< every other operation
};

/// The primitive that owns a place, or nothing where the place is outside the solid.
///
/// `inside(i)` says whether the place is in primitive i. In a union or fragment the earliest child that holds
/// the place owns it; in an intersection or difference the first child does.
template <std::predicate<std::uint32_t> Inside>
std::optional<std::uint32_t> owner(const CsgTree& tree, const Inside& inside) {
    switch (tree.operation) {
        case Operation::leaf:
            return inside(tree.primitive) ? std::optional(tree.primitive) : std::nullopt;
        case Operation::join:
        case Operation::fragment:
            for (const CsgTree& child : tree.children)
                if (auto found = owner(child, inside)) return found;
            return std::nullopt;
        case Operation::intersection:
        case Operation::difference: {
            if (tree.children.empty()) return std::nullopt;
            const auto found = owner(tree.children.front(), inside);
            if (!found) return std::nullopt;
            const bool wanted = tree.operation == Operation::intersection;
            for (std::size_t i = 1; i < tree.children.size(); ++i)
                if (owner(tree.children[i], inside).has_value() != wanted) return std::nullopt;
            return found;
        }
    }
    return std::nullopt;
}

}  // namespace maille::modeler
