#pragma once

#include <optional>

#include "modeler/remesh_session.hh"

namespace maille::modeler::remeshing {

/// The complex as a net: its patches found, its vertices sorted into faces, curves and corners. Vertices that
/// no facet uses stay in it unused. Sizes are those of the geometry alone.
Net make_net(const FacetComplex& complex, const RemeshGeometry& geometry);

/// The net as a complex, and nothing that is no longer used. Vertices and facets keep their order.
FacetComplex make_complex(const Net& net);

/// The kind of a vertex in the midst of a curve between these surfaces.
VertexKind curve_kind(const RemeshGeometry& geometry, std::span<const std::uint32_t> surfaces, const Vec3& p);

/// The point near p on all these surfaces, for a vertex of this kind; nothing if there is none, or none
/// nearer than `reach`.
std::optional<Vec3> nearest(const Session& session, std::span<const std::uint32_t> surfaces, VertexKind kind,
                            const Vec3& p, double reach);

}  // namespace maille::modeler::remeshing
