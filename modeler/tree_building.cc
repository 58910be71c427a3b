#include "modeler/tree_building.hh"

#include <algorithm>
#include <iterator>
#include <utility>

namespace maille::modeler {
namespace {

template <typename Visit>
void for_each_leaf(CsgTree& tree, const Visit& visit) {
    if (tree.operation == Operation::leaf) visit(tree);
    for (CsgTree& child : tree.children) for_each_leaf(child, visit);
}

std::vector<CsgTree> with_unions_opened(std::vector<CsgTree> children) {
    std::vector<CsgTree> result;
    for (CsgTree& child : children) {
        if (child.operation == Operation::join)
            std::ranges::move(child.children, std::back_inserter(result));
        else
            result.push_back(std::move(child));
    }
    return result;
}

}  // namespace

bool is_empty(const CsgTree& tree) {
    return tree.operation == Operation::join && tree.children.empty();
}

CsgTree combine(Operation operation, std::vector<CsgTree> children) {
    CsgTree empty;
    if (operation == Operation::intersection && std::ranges::any_of(children, is_empty)) return empty;
    if (operation == Operation::difference && !children.empty() && is_empty(children.front())) return empty;
    std::erase_if(children, is_empty);
    if (operation == Operation::join) children = with_unions_opened(std::move(children));
    if (children.empty()) return empty;
    if (children.size() == 1) return std::move(children.front());
    return {.operation = operation, .children = std::move(children)};
}

std::optional<std::uint32_t> unbounded_leaf(const CsgTree& tree,
                                            const std::function<bool(std::uint32_t)>& is_unbounded) {
    const auto of_child = [&](const CsgTree& child) { return unbounded_leaf(child, is_unbounded); };
    switch (tree.operation) {
        case Operation::leaf:
            return is_unbounded(tree.primitive) ? std::optional(tree.primitive) : std::nullopt;
        case Operation::difference:
            return of_child(tree.children.front());
        case Operation::intersection: {
            std::optional<std::uint32_t> first;
            for (const CsgTree& child : tree.children) {
                const auto leaf = of_child(child);
                if (!leaf) return std::nullopt;
                if (!first) first = leaf;
            }
            return first;
        }
        case Operation::join:
        case Operation::fragment:
            break;
    }
    for (const CsgTree& child : tree.children)
        if (const auto leaf = of_child(child)) return leaf;
    return std::nullopt;
}

void drop_unused_primitives(Model& model) {
    std::vector<bool> used(model.primitives.size(), false);
    for_each_leaf(model.tree, [&](const CsgTree& leaf) { used[leaf.primitive] = true; });
    std::vector<std::uint32_t> new_index(model.primitives.size());
    std::vector<Primitive> kept;
    for (std::size_t i = 0; i < used.size(); ++i) {
        new_index[i] = static_cast<std::uint32_t>(kept.size());
        if (used[i]) kept.push_back(std::move(model.primitives[i]));
    }
    model.primitives = std::move(kept);
    for_each_leaf(model.tree, [&](CsgTree& leaf) { leaf.primitive = new_index[leaf.primitive]; });
}

}  // namespace maille::modeler
