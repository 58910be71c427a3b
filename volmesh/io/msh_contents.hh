#pragma once

#include <compare>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "volmesh/io/mesh_draft.hh"
#include "volmesh/io/msh_source.hh"
#include "volmesh/io/number_map.hh"

/// What the sections of Gmsh's two formats have in common.
namespace maille::volmesh::io::msh {

using Index = TetMesh::Index;

/// A physical group, or an elementary entity.
struct DimTag {
    std::int32_t dimension;
    std::int32_t tag;
    auto operator<=>(const DimTag&) const = default;
};

struct Contents {
    MeshDraft draft;
    NumberMap nodes, cells;
    std::vector<std::pair<DimTag, std::string>> names;
    /// Of an elementary entity, where the file tells them entity by entity.
    std::map<DimTag, std::vector<std::int32_t>> groups_of_entity;
    /// By group: places in the draft's list of its kind.
    std::map<DimTag, std::vector<Index>> members;
    std::vector<std::pair<std::string, FieldType>> vertex_types, cell_types;
    /// Where the cells of the file were in the mesh: the first of each run that follow each other, and how
    /// many.
    std::vector<std::pair<Index, Index>> cell_order;
    using Named = std::pair<std::string, EntityKind>;
    std::vector<std::pair<Named, RuleDraft>> set_rules;
    std::vector<std::pair<Named, PropertyRule>> property_rules;
};

/// Gmsh's numbers for the elements that a mesh is read from.
enum ElementType : std::int32_t { line = 1, triangle = 2, tetrahedron = 4, point = 15 };

/// Number of nodes; throws InputError, naming the type, where it is none of the four above.
int n_nodes(const MshSource& source, std::int32_t element_type);

/// Puts elements in the lists of the draft and of their groups. Each is given by its number and those of its
/// nodes, one after another.
void add_elements(Contents& contents, const MshSource& source, std::int32_t type,
                  std::span<const std::uint64_t> numbers, std::span<const std::int32_t> groups);

/// Throws InputError where two nodes have the same number.
void sort_nodes(Contents& contents, const MshSource& source);

/// The cells that no set has are put in a group of that name, since Gmsh saves, and others read, nothing
/// outside groups once there is one.
inline constexpr const char* group_of_rest = "(no set)";

/// $MailleRules; and what to do when all is read.
void read_rules(Contents& contents, MshSource& source);
void set_rules(Contents& contents);

// ---- the sections of one version
// ----------------------------------------------------------------------------------
void read_entities(Contents& contents, MshSource& source);
void read_partitioned_entities(Contents& contents, MshSource& source);
void read_nodes41(Contents& contents, MshSource& source);
void read_elements41(Contents& contents, MshSource& source);
void read_nodes22(Contents& contents, MshSource& source);
void read_elements22(Contents& contents, MshSource& source);

}  // namespace maille::volmesh::io::msh
