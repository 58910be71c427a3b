#include "modeler/model.hh"

#include <fmt/format.h>

namespace maille::modeler {

Eigen::AlignedBox3d bounding_box(const CsgTree& tree, const std::vector<Primitive>& primitives) {
    if (tree.operation == Operation::leaf) return primitives[tree.primitive].shape->bounding_box();
    Eigen::AlignedBox3d box;
    for (const CsgTree& child : tree.children) {
        const bool is_first = &child == &tree.children.front();
        if (tree.operation == Operation::difference && !is_first) break;
        const Eigen::AlignedBox3d part = bounding_box(child, primitives);
        if (tree.operation == Operation::intersection && !is_first)
            box = box.intersection(part);
        else
            box.extend(part);
    }
    return box.isEmpty() ? Eigen::AlignedBox3d() : box;
}

Eigen::AlignedBox3d bounding_box(const Model& model) {
    return bounding_box(model.tree, model.primitives);
}

double diagonal(const Model& model) {
    Eigen::AlignedBox3d box;
    for (const Primitive& primitive : model.primitives) box.extend(primitive.shape->bounding_box());
    return box.isEmpty() ? 0 : box.diagonal().norm();
}

std::vector<ModelSurface> surfaces(const Model& model) {
    std::vector<ModelSurface> result;
    for (std::uint32_t index = 0; index < model.primitives.size(); ++index) {
        const Primitive& primitive = model.primitives[index];
        const auto faces = primitive.shape->faces();
        for (std::uint32_t face = 0; face < faces.size(); ++face)
            result.push_back({.primitive = index,
                              .face = face,
                              .name = primitive.surface_names.empty()
                                          ? fmt::format("{}/{}", primitive.name, faces[face].name)
                                          : primitive.surface_names[face]});
    }
    return result;
}

}  // namespace maille::modeler
