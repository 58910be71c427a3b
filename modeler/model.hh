#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "modeler/csg_tree.hh"
#include "modeler/primitive.hh"
#include "volmesh/projector.hh"

namespace maille::modeler {

/// Which geometry a round solid of the model language has.
enum class Facets : std::uint8_t {
    automatic,  ///< facets where 3 <= $fn <= 8, round elsewhere
    keep,       ///< the polyhedron that OpenSCAD would make
    round       ///< always round
};

/// A constructive solid: primitives, and the tree that combines them.
struct Model {
    std::vector<Primitive> primitives;  ///< the leaves, by number
    CsgTree tree;                       ///< how they are combined
};

/// A smooth surface of the model: a face of one of its primitives.
struct ModelSurface {
    std::uint32_t primitive;  ///< number in the model
    std::uint32_t face;       ///< number in the primitive
    std::string name;  ///< the face set of the boundary faces that lie on it: "<primitive>/<face>", or given
};

/// All surfaces of the model, primitive by primitive, face by face. The position in this list is the number
/// of the surface everywhere in the modeler.
std::vector<ModelSurface> surfaces(const Model& model);

/// A box around the solid that the tree makes, from those of the primitives: as small as can be for unions; what
/// is cut off may leave it too large. Empty where the solid certainly is.
Eigen::AlignedBox3d bounding_box(const Model& model);
/// The same of a part of a tree over the primitives.
Eigen::AlignedBox3d bounding_box(const CsgTree& tree, const std::vector<Primitive>& primitives);

/// The diagonal of the box around all primitives, also of what is cut off; 0 where there is none.
double diagonal(const Model& model);

/// Faces between two regions of the mesh lie on a surface too, but are no part of its boundary: their face
/// set has the surface's name with this after it.
inline constexpr std::string_view inner_suffix = "/inner";

/// Reads a model file: Netgen's CSG where it ends in .geo (`facets` does not matter then), else OpenSCAD's
/// dump with the language's own additions. Throws InputError with file, line and column on anything that it
/// cannot use.
Model read_model(const std::filesystem::path& path, Facets facets = Facets::automatic);

/// OpenSCAD's dump from memory; `name` stands for the file in messages.
Model parse_model(std::string_view text, const std::string& name, Facets facets = Facets::automatic);

/// Netgen's CSG (`algebraic3d`) from memory. One part of the mesh for each top-level object, which is called
/// by its name and has its material.
Model parse_geo_model(std::string_view text, const std::string& name);

/// The point nearest to p that lies on all the surfaces given by number, as volmesh::Projector has it. It
/// holds the shapes, and outlives the model.
using SurfaceProjection =
    std::function<std::optional<Point>(std::span<const std::uint32_t> surfaces, const Point& p)>;
SurfaceProjection surface_projection(const Model& model);

/// The model's surfaces as a mesh asks for them, by the names of its face sets. It holds the shapes, and
/// outlives the model. Its surfaces are those of `surfaces(model)`, of which several may bear one name (two
/// holes called "hole"), followed by the same with `inner_suffix`, and by the boundary names of primitives.
volmesh::Projector projector(const Model& model);

}  // namespace maille::modeler
