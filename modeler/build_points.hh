#pragma once

#include <span>
#include <vector>

#include "modeler/merge_operand.hh"
#include "modeler/model.hh"
#include "modeler/tessellate_insert.hh"
#include "quality/projection_result.hh"

namespace maille::modeler {

/// What would have to be vertices, so that flat triangles cross as the true surfaces do.
struct PointsToMeet {
    std::size_t n_vertices;                      ///< that are short of their surfaces without need
    std::vector<std::vector<FacePoint>> points;  ///< by primitive
};

/// Where flat triangles cross otherwise than the true surfaces do, vertices of the merged mesh are short of
/// their surfaces. These are the points that all round faces there should have as vertices: where the
/// surfaces meet, if they do so near the vertex, and the place on each that is nearest to it. Where that is
/// next to a vertex of an operand, or to another of the points, they have that instead: no point comes close
/// to another. A vertex that is as near to all its surfaces as the rounded coordinates of a model can tell
/// (see `on_surface`) needs none.
PointsToMeet points_to_meet(const Model& model, std::span<const Operand> operands, const Merged& merged,
                            std::span<const quality::ShortOfTarget> short_of_target);

}  // namespace maille::modeler
