#pragma once

#include <vector>

#include "modeler/shapes.hh"

namespace maille::modeler {

/// Turns faces round so that neighbours pass their common edge in opposite senses: in each connected piece of
/// the surface, those that disagree with most others. Where an edge does not belong to just two faces, or a
/// piece has one side only, its faces stay as they are.
void agree_on_sense(std::vector<PolyhedronFace>& faces);

/// Turns the pieces of a closed surface outwards: all of it if it encloses less than nothing, then each piece
/// that does and is within no other's box. Pieces in the box of another may be the walls of cavities.
/// Throws InputError where the surface encloses no volume.
void turn_outwards(const std::vector<Point>& points, std::vector<PolyhedronFace>& faces);

}  // namespace maille::modeler
