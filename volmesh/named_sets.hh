#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "volmesh/handles.hh"

namespace maille::volmesh {

class TetMesh;

/// What a set has as members, or a property belongs to.
enum class EntityKind : std::uint8_t { vertex, edge, face, cell };

/// How a named set passes to what an edge split a-b -> a-m-b creates.
///
/// Cell, edge and face sets: `copy` (the children of a member are members: the default) or `none`. Entities
/// that the split creates inside others, with no parent of their own kind, are in no set. Vertex sets: `none`
/// (a point load stays a point load: the default), `both_ends`, `from_edges`, `from_faces`. Every kind:
/// `custom`.
struct SetRule {
    /// As the functions below say.
    enum class Kind : std::uint8_t { copy, none, both_ends, from_edges, from_faces, custom };

    /// Whether the new entity is a member. `entity` holds its vertices, ascending. For cell, edge and face
    /// sets it is asked for each child of a member; for vertex sets for each new vertex.
    using Function = std::function<bool(const TetMesh&, std::span<const VertexHandle> entity, VertexHandle a,
                                        VertexHandle b, VertexHandle m)>;

    Kind kind = Kind::copy;  ///< what the functions below choose
    SetHandle source{};      ///< the set that the rule looks at, if it does
    Function function{};     ///< of Kind::custom

    /// The children of a member are members.
    static SetRule copy() { return {Kind::copy, {}, {}}; }
    /// What is new is in no such set.
    static SetRule none() { return {Kind::none, {}, {}}; }
    /// m is a member if a and b are and, where a source is given, the edge a-b lies in it: it is a member of
    /// the edge set, or an edge of a member of the face set or of the cell set.
    static SetRule both_ends(SetHandle source = {}) { return {Kind::both_ends, source, {}}; }
    /// m is a member if the edge a-b is in that edge set.
    static SetRule from_edges(SetHandle edge_set) { return {Kind::from_edges, edge_set, {}}; }
    /// m is a member if a face at the edge a-b is in that face set.
    static SetRule from_faces(SetHandle face_set) { return {Kind::from_faces, face_set, {}}; }
    /// As the function says. No file keeps it.
    static SetRule custom(Function f) { return {Kind::custom, {}, std::move(f)}; }
};

/// What a set is, but for its members.
struct SetInfo {
    std::string name;  ///< unique among the sets of the kind
    EntityKind kind;   ///< of its members
    SetRule rule;      ///< how it passes to what edits create
};

/// Number of an interned combination of sets; 0 is the empty one.
using CombinationId = std::uint32_t;

/// The sets of a mesh, and the combinations in which its entities are in them.
///
/// An entity that is in any set holds one number, that of its combination. A cell holds one more, that of its
/// row: the combinations of the cell, of its four faces and of its six edges, seen from its local numbering.
/// Splitting an edge of a cell turns its row into two others, which depends on the row and the local edge
/// alone: it is worked out once and then looked up. So heritage costs a look-up a cell, however many sets
/// there are.
class NamedSets {
  public:
    struct Row {
        CombinationId cell = 0;
        std::array<CombinationId, 4> faces{};
        std::array<CombinationId, 6> edges{};
        bool has_cell_sets_only() const {
            return faces == std::array<CombinationId, 4>{} && edges == std::array<CombinationId, 6>{};
        }
        auto operator<=>(const Row&) const = default;
    };
    using RowId = std::uint32_t;

    NamedSets();

    SetHandle add(SetInfo info);
    SetHandle find(const std::string& name, EntityKind kind) const;
    const SetInfo& info(SetHandle set) const { return infos_[set.idx()]; }
    std::uint32_t size() const { return static_cast<std::uint32_t>(infos_.size()); }

    std::span<const SetHandle> combination(CombinationId id) const { return combinations_[id]; }
    bool contains(CombinationId id, SetHandle set) const;
    /// The combination with the set put in or taken out.
    CombinationId with(CombinationId id, SetHandle set);
    CombinationId without(CombinationId id, SetHandle set);
    /// The combination of these sets, in any order, repeats allowed.
    CombinationId intern(std::vector<SetHandle> sets);

    const Row& row(RowId id) const { return rows_[id]; }
    RowId intern(const Row& row);
    std::uint32_t n_rows() const { return static_cast<std::uint32_t>(rows_.size()); }

    static constexpr std::uint32_t unknown = ~std::uint32_t{0};

    /// What the split of a cell's edge passes on.
    struct Heritage {
        /// Rows of the child that keeps the edge's first end, and of the one that keeps its second. Custom
        /// rules are taken as `copy` here.
        std::pair<RowId, RowId> children{unknown, unknown};
        /// The sets that the edge lies in as this cell sees it (the cell's, its two faces' and the edge's
        /// own), as far as rules of vertex sets name them as their source.
        CombinationId sources = unknown;
        bool is_known() const { return sources != unknown; }
    };
    /// What decides on the sets of a vertex born on an edge: the sources round it, the combinations of its
    /// ends.
    struct Birth {
        CombinationId sources, at_a, at_b;
        friend bool operator==(const Birth&, const Birth&) = default;
    };

    // What was once asked for is remembered. Constant sets only look up, which threads may do together, and
    // give `unknown` where they don't remember.
    const Heritage& heritage(RowId id, int local_edge) const { return heritages_[id][local_edge]; }
    const Heritage& heritage(RowId id, int local_edge);
    CombinationId unite(CombinationId a, CombinationId b) const;
    CombinationId unite(CombinationId a, CombinationId b);
    /// The vertex sets that the new vertex is in by rule.
    CombinationId born(const Birth& birth) const;
    CombinationId born(const Birth& birth);

    /// The sets whose rule is custom.
    std::span<const SetHandle> custom() const { return custom_; }

    /// What parts of an entity are in: the sets whose rule is not `none`.
    CombinationId inherited(CombinationId id);

  private:
    struct Hash {
        std::size_t operator()(const Birth& birth) const {
            return (birth.sources * 0x9e3779b97f4a7c15U + birth.at_a) * 0x9e3779b97f4a7c15U + birth.at_b;
        }
    };

    CombinationId sources_at(const Row& row, int local_edge);

    std::vector<SetInfo> infos_;
    std::map<std::pair<std::string, EntityKind>, SetHandle> by_name_;
    std::vector<std::vector<SetHandle>> combinations_;
    std::map<std::vector<SetHandle>, CombinationId> combination_ids_;
    std::vector<Row> rows_;
    std::map<Row, RowId> row_ids_;
    std::vector<std::vector<SetHandle>>
        born_from_;                        ///< by set: the vertex sets that it brings forth by itself
    std::vector<std::uint8_t> is_source_;  ///< by set: whether a vertex set's rule names it
    std::vector<SetHandle> custom_;

    // What is remembered, until a set is added.
    std::vector<std::array<Heritage, 6>> heritages_;  ///< by row and local edge
    std::map<std::pair<CombinationId, CombinationId>, CombinationId> unions_;
    std::unordered_map<Birth, CombinationId, Hash> births_;
};

}  // namespace maille::volmesh
