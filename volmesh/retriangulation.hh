#pragma once

#include <array>

#include <boost/container/small_vector.hpp>

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

/// Cells to be taken out, and those that fill their place: what every local edit but the split of an edge is.
///
/// The new cells are positively oriented, fill the place of the old ones and use no vertices but theirs (and
/// such as have no cell yet). Faces and edges that are there before and after keep their sets, values and
/// numbers; those that are born are in no set unless a parent is named. Extensive values
/// (PropertyRule::share) of what vanishes go to what is born in the same sets, else to what stays in them, by
/// measure.
struct Retriangulation {
    /// A cell that is born.
    struct NewCell {
        std::array<VertexHandle, 4> vertices;  ///< positively oriented
        CellHandle parent;                     ///< the old cell whose sets and values it takes
    };
    /// A face that is born in the sets of an old one.
    struct NewFace {
        std::array<VertexHandle, 3> vertices;  ///< in any order
        HalffaceHandle parent;                 ///< whichever side of the old one
    };

    CellList old_cells;                                      ///< that go; no one twice
    boost::container::small_vector<NewCell, 24> new_cells;   ///< that take the old ones' indices first
    boost::container::small_vector<NewFace, 4> new_faces{};  ///< those that are in sets
    VertexHandle gone{};  ///< where an edge is collapsed: the end that goes,
    VertexHandle heir{};  ///< and the one that stands for it from then on
    /// Whether what is born divides its parent, so that the sets' rules have a say.
    bool divides = false;
};

}  // namespace maille::volmesh
