#pragma once

#include <array>
#include <string_view>

#include "volmesh/tet_mesh.hh"

/// What the reader and the writer of Abaqus' input files (.inp, CalculiX's too) agree upon.
///
/// Labels of sets are short, of few characters and the same in upper and lower case. So each set has a
/// comment
///
///     **maille set KIND LABEL "name"
///
/// with its name as a JSON string, and `**maille rule "..."` where its rule is not the usual one; edges, for
/// which there is no keyword, follow theirs as `**maille edge A B`. Solvers want all nodes and elements in a
/// set: `**maille all LABEL` says which label is no set of the mesh.
namespace maille::volmesh::io::abaqus {

inline constexpr std::string_view note_sign = "**maille ";

inline constexpr std::array<std::string_view, 4> kind_names{"vertex", "edge", "face", "cell"};

/// Vertices of a C3D4's sides S1 to S4, by their place in the element.
inline constexpr std::array<std::array<int, 3>, 4> sides{{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};

}  // namespace maille::volmesh::io::abaqus
