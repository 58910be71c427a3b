#pragma once

#include "modeler/remesh_net.hh"

namespace maille::modeler::remeshing {

/// The neighbours of v; on a curve those along it.
std::vector<Index> neighbours_alike(const Net& net, Index v);
/// The middle of these vertices.
Vec3 middle(const Net& net, std::span<const Index> vertices);

/// The change that moves v, its triangles the same.
Change move(const Net& net, Index v, const Vec3& to);

/// Whether the neighbours u and w have no others in common than those across from the edge between them.
bool are_linked(const Net& net, Index u, Index w);

/// Whether the complex keeps its topology when u is drawn onto its neighbour w (the link condition, and that
/// of the curves).
bool keeps_topology(const Net& net, Index u, Index w);

/// The change that draws u onto its neighbour w.
Change collapse(const Net& net, Index u, Index w);
/// The same, and moves w.
Change collapse(const Net& net, Index u, Index w, const Vec3& to);

}  // namespace maille::modeler::remeshing
