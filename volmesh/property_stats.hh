#pragma once

#include <iosfwd>

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

/// Prints the properties of a mesh, one a line: kind, name, type, number of values and rule; for one of the
/// whole mesh its value. A single value of any property in words is `BaseProperty::text(index)`.
void property_stats(const TetMesh& mesh, std::ostream& out);

/// The type in C++'s words: "double", "Vector3d".
std::string type_name_of(const BaseProperty& property);

}  // namespace maille::volmesh
