#include "modeler/model.hh"

#include <fmt/format.h>

namespace maille::modeler {

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
