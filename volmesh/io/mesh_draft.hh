#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "volmesh/io/fields.hh"
#include "volmesh/io/rule_text.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::volmesh::io {

/// What a reader gathers from a file, before it is a mesh.
struct MeshDraft {
    using Index = TetMesh::Index;

    /// Members by number: of a point, or in the list of edges, faces or cells below.
    struct Set {
        std::string name;
        EntityKind kind;
        std::vector<Index> members;
        std::optional<RuleDraft> rule{};  ///< none: the kind's usual one
    };

    std::vector<Point> points;
    std::vector<std::array<Index, 4>> cells;
    /// Lines and triangles of the file that matter, as they are in sets. They may be there more than once.
    std::vector<std::array<Index, 2>> edges;
    std::vector<std::array<Index, 3>> faces;
    std::vector<Set> sets;
    std::vector<Field> fields;
    std::vector<MeshValue> mesh_values;

    /// The set of that name and kind, made where there is none. Valid until the next one is made.
    Set& set(const std::string& name, EntityKind kind);
    /// That set if there is one.
    const Set* find_set(const std::string& name, EntityKind kind) const;

  private:
    std::map<std::pair<std::string, EntityKind>, std::size_t> set_numbers_;
};

/// `group<number>`, for a group that has no name.
std::string group_name(long long number);

/// Kind of set for a group of that dimension: 0 vertices to 3 cells.
EntityKind kind_of_dimension(int dimension);

/// The mesh. Cells that are inside out are turned. Throws InputError, naming the path, where indices are out
/// of range, the cells are no mesh, or a line or triangle is no part of them.
TetMesh assemble(MeshDraft draft, const std::filesystem::path& path);

}  // namespace maille::volmesh::io
