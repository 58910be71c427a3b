#pragma once

#include <span>
#include <vector>

#include "modeler/merge_operand.hh"
#include "modeler/model.hh"
#include "modeler/tessellate_insert.hh"
#include "quality/projection_result.hh"

namespace maille::modeler {

/// Where flat triangles cross otherwise than the true surfaces do, vertices of the merged mesh are short of
/// their surfaces. These are the points, by primitive, that all round faces there should have as vertices:
/// where the surfaces meet, if they do so near the vertex, and the place on each that is nearest to it.
/// Where that is next to a vertex of an operand, or to another of the points, they have that instead: no
/// point comes close to another.
std::vector<std::vector<FacePoint>> points_to_meet(const Model& model, std::span<const Operand> operands,
                                                   const Merged& merged,
                                                   std::span<const quality::ShortOfTarget> short_of_target);

}  // namespace maille::modeler
