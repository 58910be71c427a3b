#pragma once

#include <array>
#include <vector>

#include <boost/container/small_vector.hpp>

#include "volmesh/retriangulation.hh"

namespace maille::volmesh {

/// A face or an edge of a cavity: what it is known by, its sets, and with whom it shares values.
template <class Key>
struct CavityPart {
    Key key;
    CombinationId sets;
    CombinationId group;  ///< sets of what it comes from: values are shared among a group
    std::uint32_t number;
    std::uint32_t parent;  ///< number of what its values come from; `none` where it has no parent
    double measure;
};
using FaceKey = std::array<std::uint32_t, 3>;  ///< ascending
using FacePart = CavityPart<FaceKey>;
using EdgePart = CavityPart<std::uint64_t>;
template <class Part>
using CavityParts = boost::container::small_vector<Part, 48>;

/// A cavity as it was before its cells are replaced, and where the new ones go.
struct Cavity {
    struct Outside {
        FaceKey key;
        std::uint32_t halfface;  ///< of the cell beyond
    };

    boost::container::small_vector<Outside, 48> outside;
    boost::container::small_vector<std::uint32_t, 24> slots;    ///< of the new cells
    boost::container::small_vector<NamedSets::RowId, 24> rows;  ///< of the old ones
    /// Faces and edges of the old cells: all where they are numbered, else those in sets.
    CavityParts<FacePart> faces;
    CavityParts<EdgePart> edges;
    CavityParts<FacePart> born_faces;  ///< that have a parent
    /// The cavity's vertices and their cells, where fans may change; else empty.
    std::vector<VertexHandle> hinges;
    std::vector<CellList> cells_at;
};

}  // namespace maille::volmesh
