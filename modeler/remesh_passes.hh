#pragma once

#include "modeler/remesh_session.hh"

namespace maille::modeler::remeshing {

// Every pass goes through the whole net once, in an order that depends on the net alone, and returns the
// number of changes made. It changes only what is better for it.

/// Draws together the ends of edges that are too short, and of those that make bad triangles.
std::size_t collapse_edges(Session& session);

/// Halves edges that are too long, longest first. New vertices lie on the surfaces.
std::size_t split_edges(Session& session);

/// Turns edges within a patch where the smallest angle grows by it.
std::size_t flip_edges(Session& session);

/// Draws the apex of a flat triangle onto the curve along its longest edge.
std::size_t snap_to_curves(Session& session);

/// Moves vertices onto their surfaces, corners too.
std::size_t project_vertices(Session& session);

/// Brings vertices onto their surfaces that others are in the way of: those that may go are drawn onto them.
std::size_t clear_ways(Session& session);

/// Moves vertices of bad triangles along their surfaces where the smallest angle grows by it.
std::size_t smooth_vertices(Session& session);

/// The number of vertices in use that are not on all their surfaces.
std::size_t count_short_of_surface(const Session& session);

/// Sets the wanted length of edges at every vertex: that of the geometry, less where sheets or curves are
/// close to each other, like that of frozen edges beside them, and growing slowly from place to place.
void set_sizes(Session& session);

}  // namespace maille::modeler::remeshing
