#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <ranges>
#include <span>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "volmesh/column.hh"
#include "volmesh/edge_stars.hh"
#include "volmesh/handles.hh"
#include "volmesh/member_lists.hh"
#include "volmesh/named_sets.hh"
#include "volmesh/properties.hh"
#include "volmesh/status.hh"
#include "volmesh/tet_navigation.hh"
#include "volmesh/tet_topology.hh"

namespace maille::volmesh {

/// A place, in the unit of length that the user chose.
using Point = Eigen::Vector3d;

template <class H>
class EntityRange;
template <class H>
struct SmartHandle;
struct Retriangulation;
struct Cavity;
struct CellExchange;
struct ExchangedNumbers;

/// Where each old index went in a garbage collection; the invalid index for what is gone.
struct IndexMaps {
    ///@{
    /// By old index; of edges and faces there are none where they are not numbered.
    std::vector<std::uint32_t> vertices, edges, faces, cells;
    ///@}
};

/// A tetrahedral mesh with properties and named sets. A value: it copies deeply and moves.
///
/// Stored are the cells' vertices, their neighbours across faces, a cell of each vertex and the points: some
/// 40 bytes a cell. Edges and faces are numbered when they are first asked for by handle (some 55 bytes a
/// cell more); from then on every edit keeps their numbers. Half-faces are 4 * cell + local face and always
/// there. That first numbering changes the mesh: before threads share it, call request_edges() or
/// request_faces().
///
/// Boundaries need not be manifold: cells that touch in a vertex or an edge only are found by every query.
class TetMesh : public TetNavigation {
  public:
    using Index = std::uint32_t;  ///< of an entity; at most some 500 million cells fit
    static constexpr Index none = VertexHandle::invalid_index;  ///< where there is no entity

    /// A cell as it is stored, so that a step from cell to cell takes one line of the cache.
    struct alignas(32) Cell {
        std::array<Index, 4> vertices;   ///< positively oriented
        std::array<Index, 4> neighbors;  ///< by local face: the half-face on the other side
    };

    // ---- making
    /// The mesh of these cells, each four vertex indices, positively oriented: (v1-v0)x(v2-v0).(v3-v0) > 0.
    /// Orientation is not checked (see validate); throws InputError where an index is out of range, a cell
    /// has a vertex twice or more than two cells share a face, naming the cells.
    static TetMesh from_cells(std::vector<Point> points, std::vector<std::array<Index, 4>> cells);
    /// The same of cells that know neighbours: those that are `none` are looked for, which is most of the
    /// work. That the others are mutual and of the same vertices is not checked. The cells are not copied.
    static TetMesh from_linked_cells(std::vector<Point> points, Column<Cell> cells);

    /// A vertex without cells, in no set and with the properties' defaults.
    VertexHandle add_vertex(const Point& p);
    /// A cell of these vertices, in no cell set; faces and edges that are there already stay in their sets.
    /// Throws std::invalid_argument, naming what is wrong, where the cell is inverted or flat, one of its
    /// faces already has two cells, or it overlaps a cell at one of its vertices (decided exactly, some 10 us
    /// for each cell there; from_cells is for many). Overlaps elsewhere are find_overlaps()'s matter.
    CellHandle add_cell(VertexHandle v0, VertexHandle v1, VertexHandle v2, VertexHandle v3);

    // ---- counts and ranges
    ///@{
    /// Number of indices in use, deleted entities included until garbage_collection(). The first question for
    /// edges numbers them, as request_edges() does.
    Index n_vertices() const { return static_cast<Index>(points_.size()); }
    Index n_cells() const { return static_cast<Index>(cells_.size()); }
    Index n_halffaces() const { return 4 * n_cells(); }
    Index n_edges() const;
    Index n_halfedges() const { return 2 * n_edges(); }
    Index n_faces() const;
    ///@}
    /// Number of faces that have one cell only.
    Index n_boundary_faces() const { return n_boundary_; }

    ///@{
    /// All that are not deleted, in ascending order, as smart handles.
    EntityRange<VertexHandle> vertices() const;
    EntityRange<EdgeHandle> edges() const;
    EntityRange<HalfedgeHandle> halfedges() const;
    EntityRange<FaceHandle> faces() const;
    EntityRange<CellHandle> cells() const;
    EntityRange<HalffaceHandle> halffaces() const;
    ///@}
    /// Half-faces that have no opposite, seen from their cell; their vertices turn counter-clockwise from
    /// outside.
    EntityRange<HalffaceHandle> boundary_halffaces() const;
    /// The same as faces, which get numbers.
    EntityRange<FaceHandle> boundary_faces() const;

    // ---- geometry
    const Point& point(VertexHandle v) const { return points_[v.idx()]; }  ///< where a vertex is
    /// Moves a vertex. Nobody checks that its cells stay positively oriented.
    void set_point(VertexHandle v, const Point& p) { points_[v.idx()] = p; }
    /// The places of all vertices by index, deleted ones included. Valid until one is added.
    std::span<const Point> points() const { return {points_.data(), points_.size()}; }
    std::array<Point, 4> cell_points(CellHandle c) const;  ///< in the order of cell_vertices

    // ---- cells and half-faces
    std::array<VertexHandle, 4> cell_vertices(CellHandle c) const;  ///< positively oriented
    /// That of a local number, 0 to 3.
    VertexHandle cell_vertex(CellHandle c, int local) const {
        return VertexHandle(cells_[c.idx()].vertices[local]);
    }
    /// The vertices of every cell, by cell index.
    std::ranges::random_access_range auto cell_vertex_indices() const {
        return std::views::transform(std::span<const Cell>(cells_.data(), cells_.size()), &Cell::vertices);
    }
    /// Local number of a vertex in a cell, -1 where it isn't one of the cell's.
    int local_vertex(CellHandle c, VertexHandle v) const;
    /// Local number of the edge in the cell, -1 where the cell doesn't have both.
    int local_edge(CellHandle c, VertexHandle a, VertexHandle b) const;

    /// The face of the cell opposite its local vertex of that number.
    static HalffaceHandle halfface(CellHandle c, int local_face) {
        return HalffaceHandle(4 * c.idx() + local_face);
    }
    /// The cell from which the half-face is seen.
    static CellHandle incident_cell(HalffaceHandle hf) { return CellHandle(hf.idx() / 4); }
    /// The number of the half-face in its cell, 0 to 3.
    static int local_face(HalffaceHandle hf) { return static_cast<int>(hf.idx() % 4); }
    /// The same face seen from the cell on its other side; invalid on the boundary.
    HalffaceHandle opposite_halfface_handle(HalffaceHandle hf) const {
        return HalffaceHandle(cells_[hf.idx() / 4].neighbors[hf.idx() % 4]);
    }
    /// Counter-clockwise seen from outside the cell.
    std::array<VertexHandle, 3> halfface_vertices(HalffaceHandle hf) const;
    /// The half-face of these three vertices that turns as given if there is one, else the other way round;
    /// invalid where there is no such face.
    HalffaceHandle find_halfface(VertexHandle a, VertexHandle b, VertexHandle c) const;
    /// The cell of these vertices, in whatever order; invalid where there is none. Cost: the cells at a.
    CellHandle find_cell(VertexHandle a, VertexHandle b, VertexHandle c, VertexHandle d) const;
    ///@{
    /// Whether the face has one cell only; for a cell, whether one of its faces has; for vertices and edges,
    /// whether such a face has them. Cost: the cells there.
    bool is_boundary(HalffaceHandle hf) const { return !opposite_halfface_handle(hf).is_valid(); }
    bool is_boundary(CellHandle c) const;
    bool is_boundary(VertexHandle v) const;
    bool is_boundary(EdgeHandle e) const;
    bool is_boundary(HalfedgeHandle h) const { return is_boundary(edge_handle(h)); }
    bool is_boundary(FaceHandle f) const { return is_boundary(halfface_handle(f, 0)); }
    ///@}

    // ---- incidence
    /// Cells at a vertex. Cost: their number.
    CellList vc_range(VertexHandle v) const;
    /// Vertices that share an edge with a vertex, ascending.
    VertexList vv_range(VertexHandle v) const;
    EdgeList ve_range(VertexHandle v) const;  ///< edges at a vertex, ascending
    /// Cells round an edge: in turning order, from one boundary face to the other if it has any.
    CellList ec_range(EdgeHandle e) const;
    ///@{
    /// The same for an edge given by a cell and a local number, or by its ends (empty where there is no such
    /// edge).
    CellList cells_around(CellHandle c, int local_edge) const;
    CellList cells_around(VertexHandle a, VertexHandle b) const;
    ///@}
    FaceList ef_range(EdgeHandle e) const;  ///< faces at an edge, in the order of halffaces_around
    /// Half-faces at an edge, one a face: of faces with two cells the one with the lower index.
    boost::container::small_vector<HalffaceHandle, 48> halffaces_around(CellHandle c, int local_edge) const;
    CellList cc_range(CellHandle c) const;  ///< the cells beyond its faces, at most four

    // ---- edges and faces by handle
    ///@{
    /// Numbers them now if they aren't; release_* forgets the numbers, which has_* tells. Properties need
    /// them, and keep them from being released (std::logic_error).
    void request_edges() const;
    void request_faces() const;
    void release_edges();
    void release_faces();
    bool has_edges() const { return edges_.has_value(); }
    bool has_faces() const { return faces_.has_value(); }
    ///@}

    /// That of a local number, 0 to 5, in the order of tet::edge_vertices.
    EdgeHandle edge_handle(CellHandle c, int local_edge) const;
    FaceHandle face_handle(HalffaceHandle hf) const;  ///< that it is a side of
    /// The end with the lower vertex index first.
    std::array<VertexHandle, 2> edge_vertices(EdgeHandle e) const;
    /// As its first half-face turns.
    std::array<VertexHandle, 3> face_vertices(FaceHandle f) const {
        return halfface_vertices(halfface_handle(f, 0));
    }
    /// One cell of the edge, and the edge's local number there.
    std::pair<CellHandle, int> edge_place(EdgeHandle e) const;
    /// Side 0 always has a cell; side 1 is invalid on the boundary.
    HalffaceHandle halfface_handle(FaceHandle f, int side) const;
    ///@{
    /// The edge or face between vertices; invalid where there is none. Cost: the cells at a.
    EdgeHandle find_edge(VertexHandle a, VertexHandle b) const;
    FaceHandle find_face(VertexHandle a, VertexHandle b, VertexHandle c) const;
    ///@}
    /// Side 0 leaves the end with the lower index, side 1 the other.
    HalfedgeHandle halfedge_handle(EdgeHandle e, int side) const {
        return HalfedgeHandle(2 * e.idx() + side);
    }
    /// That it is one of the two of.
    EdgeHandle edge_handle(HalfedgeHandle h) const { return EdgeHandle(h.idx() / 2); }
    /// The same edge, the other way.
    HalfedgeHandle opposite_halfedge_handle(HalfedgeHandle h) const { return HalfedgeHandle(h.idx() ^ 1U); }
    ///@{
    /// The end that a half-edge leaves, and the one that it comes to.
    VertexHandle from_vertex_handle(HalfedgeHandle h) const {
        return edge_vertices(edge_handle(h))[h.idx() & 1U];
    }
    VertexHandle to_vertex_handle(HalfedgeHandle h) const {
        return edge_vertices(edge_handle(h))[1 - (h.idx() & 1U)];
    }
    ///@}
    EdgeList fe_range(FaceHandle f) const;  ///< the three edges of a face

    // ---- edits
    /// Splits the edge, and every cell round it, at a new vertex; `ratio` places it between the edge's ends,
    /// m = (1 - ratio) a + ratio b, a being the end that comes first in the cell given, and says how
    /// extensive quantities are shared. Each old cell keeps its index for the child with a; the children with
    /// b get new indices at the end, in the order of cells_around(). Sets and properties pass on by their
    /// rules. The point may be moved afterwards (set_point).
    VertexHandle split_edge(CellHandle c, int local_edge, double ratio = 0.5);
    /// a is the end with the lower index.
    VertexHandle split_edge(EdgeHandle e, double ratio = 0.5);
    /// As the first one, for a caller who has the cells round the edge already, as cells_around(c,
    /// local_edge) gives them.
    VertexHandle split_edge(CellHandle c, int local_edge, double ratio, const CellList& ring);
    /// Splits many edges at their middles, by as many threads as there are at hand. The result is that of
    /// split_edge for one after another, in their order; custom rules of sets and properties are asked when
    /// all are split. Returns the first of the new vertices.
    VertexHandle split_edges(const EdgeStars& stars);
    /// Cuts every cell into eight of equal volume, as octasection.hh says, round the diagonal that leaves the
    /// best shapes, by as many threads as there are at hand. The children of cell c are 8 c .. 8 c + 7, and
    /// the middles of the edges are new vertices at the end. Sets and properties pass on by their rules
    /// (extensive values in equal parts); a custom rule is told of one of the edges that were cut, that of
    /// the entity's lowest new vertex. Returns the ends of each new vertex's edge. Throws InputError where
    /// the mesh has deleted entities or gets too large. Cost: some 0.1 us a new cell.
    std::vector<std::array<VertexHandle, 2>> split_uniformly();

    /// Takes cells out and fills their place with others; retriangulation.hh says how and what is kept.
    void replace_cells(const Retriangulation& change);
    /// A vertex without cells, at the weighted mean of others and with values between theirs by the
    /// properties' rules. The weights sum to 1.
    VertexHandle add_vertex(std::span<const VertexHandle> parents, std::span<const double> weights);

    /// Takes many cells out and puts others in; cell_exchange.hh says how. Edges and faces lose their numbers
    /// (std::logic_error where they have properties, or where something is deleted). Throws InputError where
    /// more than two cells come to share a face; the mesh is of no use then. Cost: a pass over the cells,
    /// some 20 ns each, and 0.2 us for those that go, move or come.
    ExchangedNumbers exchange_cells(const CellExchange& change);

    /// Marks it deleted: its neighbours get a boundary; its vertices stay. Its index is free after
    /// garbage_collection().
    void delete_cell(CellHandle c);
    /// Marks the vertices that have no cell as deleted.
    void delete_isolated_vertices();
    ///@{
    /// Whether the entity is gone, its index being free after garbage_collection(). Edges and faces go with
    /// their last cell.
    bool is_deleted(CellHandle c) const { return !deleted_cells_.empty() && deleted_cells_[c.idx()] != 0; }
    bool is_deleted(VertexHandle v) const {
        return !deleted_vertices_.empty() && deleted_vertices_[v.idx()] != 0;
    }
    bool is_deleted(EdgeHandle e) const;
    bool is_deleted(FaceHandle f) const;
    bool is_deleted(HalfedgeHandle h) const { return is_deleted(edge_handle(h)); }
    bool is_deleted(HalffaceHandle hf) const { return is_deleted(incident_cell(hf)); }
    ///@}
    /// Whether garbage_collection() has anything to do.
    bool has_deleted() const { return !deleted_cells_.empty() || !deleted_vertices_.empty(); }
    /// Takes deleted entities out; the others keep their order. Sets and properties follow.
    IndexMaps garbage_collection();

    /// The mesh of these vertices and cells alone, in this order, with their sets and properties (and numbers
    /// of edges and faces, if they are numbered here). Throws std::invalid_argument where a vertex or cell is
    /// given twice or isn't there, or a cell's vertex isn't given.
    TetMesh taken(std::span<const VertexHandle> vertices, std::span<const CellHandle> cells) const;
    /// Puts the other mesh's entities, sets and properties behind this one's; nothing is joined where the two
    /// touch. Sets and properties of the same name and kind become one, with the rule that they have here;
    /// where only one of the two has a property, the other's entities get its default. Throws InputError
    /// where a property of the same name has another type, or both together are too large.
    void append(const TetMesh& other);

    // ---- properties
    template <class Entity, class T>
    void add_property(PropertyHandle<Entity, T>& ph, const std::string& name,
                      std::type_identity_t<PropertyHeritage<T>> heritage = {},
                      std::type_identity_t<T> default_value = initial_value<T>());
    template <class Entity, class T>
    bool get_property_handle(PropertyHandle<Entity, T>& ph, const std::string& name) const;
    /// Its values are lost and the handle is invalid from then on.
    template <class Entity, class T>
    void remove_property(PropertyHandle<Entity, T>& ph);
    ///@{
    /// The value of an entity, to be read or changed. The handle must be of a property of this mesh.
    template <class Entity, class T>
    typename Property<T>::Stored& property(PropertyHandle<Entity, T> ph, std::type_identity_t<Entity> h);
    template <class Entity, class T>
    const typename Property<T>::Stored& property(PropertyHandle<Entity, T> ph,
                                                 std::type_identity_t<Entity> h) const;
    ///@}
    /// All values, indexable by handles of the kind.
    template <class Entity, class T>
    PropertyView<Entity, T> property(PropertyHandle<Entity, T> ph) {
        return PropertyView<Entity, T>(values(ph));
    }
    /// All properties of a kind, for whoever doesn't know their names or types.
    const PropertyList& properties(EntityKind kind) const { return properties_[static_cast<int>(kind)]; }

    /// Properties of the mesh as a whole: one value each.
    template <class T>
    void add_property(MPropHandleT<T>& ph, const std::string& name,
                      std::type_identity_t<T> value = initial_value<T>());
    ///@{
    /// The value, to be read or changed.
    template <class T>
    typename Property<T>::Stored& property(MPropHandleT<T> ph);
    template <class T>
    const typename Property<T>::Stored& property(MPropHandleT<T> ph) const;
    ///@}
    const PropertyList& mesh_properties() const { return mesh_properties_; }  ///< all of them

    // ---- marks of entities: selected, tagged, feature, locked, hidden
    ///@{
    /// Makes place for marks, a byte an entity, until they are released as often as requested; has_* tells
    /// whether they are there. What a split creates has the marks of what it came from.
    template <class Entity>
    void request_status();
    template <class Entity>
    void release_status();
    template <class Entity>
    bool has_status() const {
        return status_requests_[static_cast<int>(kind_of<Entity>())] > 0;
    }
    void request_vertex_status() { request_status<VertexHandle>(); }
    void request_edge_status() { request_status<EdgeHandle>(); }
    void request_face_status() { request_status<FaceHandle>(); }
    void request_cell_status() { request_status<CellHandle>(); }
    void release_vertex_status() { release_status<VertexHandle>(); }
    void release_edge_status() { release_status<EdgeHandle>(); }
    void release_face_status() { release_status<FaceHandle>(); }
    void release_cell_status() { release_status<CellHandle>(); }
    bool has_vertex_status() const { return has_status<VertexHandle>(); }
    bool has_edge_status() const { return has_status<EdgeHandle>(); }
    bool has_face_status() const { return has_status<FaceHandle>(); }
    bool has_cell_status() const { return has_status<CellHandle>(); }
    ///@}
    ///@{
    /// Whether the entity is deleted, and its marks.
    Status status(VertexHandle v) { return {is_deleted(v), status_bits(v)}; }
    Status status(EdgeHandle e) { return {is_deleted(e), status_bits(e)}; }
    Status status(FaceHandle f) { return {is_deleted(f), status_bits(f)}; }
    Status status(CellHandle c) { return {is_deleted(c), status_bits(c)}; }
    ConstStatus status(VertexHandle v) const { return {is_deleted(v), status_bits(v)}; }
    ConstStatus status(EdgeHandle e) const { return {is_deleted(e), status_bits(e)}; }
    ConstStatus status(FaceHandle f) const { return {is_deleted(f), status_bits(f)}; }
    ConstStatus status(CellHandle c) const { return {is_deleted(c), status_bits(c)}; }
    ///@}

    // ---- named sets
    /// A new, empty set. Throws std::invalid_argument where the kind has a set of that name or the rule
    /// doesn't fit it.
    SetHandle add_set(const std::string& name, EntityKind kind, SetRule rule);
    /// With the kind's default rule: `copy`, and for vertex sets `none`.
    SetHandle add_set(const std::string& name, EntityKind kind);
    /// The set of that name and kind; invalid where there is none.
    SetHandle find_set(const std::string& name, EntityKind kind) const { return sets_.find(name, kind); }
    /// Sets are numbered from 0, of all kinds together, and are never removed.
    Index n_sets() const { return sets_.size(); }
    /// Its name, kind and rule. The handle must be of a set of this mesh.
    const SetInfo& set_info(SetHandle s) const { return sets_.info(s); }
    /// Number of members; costs what a list of them does.
    std::size_t set_size(SetHandle s) const;

    ///@{
    /// Whether the entity is a member; an edge may be given by a cell and its local number. False for one of
    /// another kind than the set's.
    bool contains(SetHandle s, VertexHandle v) const { return sets_.contains(combination(v), s); }
    bool contains(SetHandle s, CellHandle c) const { return sets_.contains(combination(c), s); }
    bool contains(SetHandle s, HalffaceHandle hf) const { return sets_.contains(combination(hf), s); }
    bool contains(SetHandle s, FaceHandle f) const { return contains(s, halfface_handle(f, 0)); }
    bool contains(SetHandle s, CellHandle c, int local_edge) const {
        return sets_.contains(combination(c, local_edge), s);
    }
    bool contains(SetHandle s, EdgeHandle e) const;
    ///@}

    ///@{
    /// Puts the entity in the set, or takes it out; nothing changes where it is so already. Throws
    /// std::invalid_argument where it is of another kind than the set's members.
    void insert(SetHandle s, VertexHandle v);
    void insert(SetHandle s, CellHandle c);
    void insert(SetHandle s, HalffaceHandle hf);  ///< the face, whichever of its half-faces is given
    void insert(SetHandle s, FaceHandle f) { insert(s, halfface_handle(f, 0)); }
    void insert(SetHandle s, CellHandle c, int local_edge);
    void insert(SetHandle s, EdgeHandle e);
    void erase(SetHandle s, VertexHandle v);
    void erase(SetHandle s, CellHandle c);
    void erase(SetHandle s, HalffaceHandle hf);
    void erase(SetHandle s, FaceHandle f) { erase(s, halfface_handle(f, 0)); }
    void erase(SetHandle s, CellHandle c, int local_edge);
    void erase(SetHandle s, EdgeHandle e);
    ///@}
    ///@{
    /// The same for many at once, some twenty times faster than one by one.
    void insert(SetHandle s, std::span<const VertexHandle> vertices);
    void insert(SetHandle s, std::span<const CellHandle> cells);
    ///@}

    ///@{
    /// Members, ascending. Faces by one half-face each, that with the lower index; edges by cell and local
    /// number, the lowest cell first. Of a set of another kind there are none.
    ///
    /// Cost: the number of members. Only the first question about sets of a kind after an edit takes a pass
    /// over the mesh, that lists all of them at once: 4 bytes a member until the next edit. Changing a set by
    /// insert or erase makes only that set be listed anew. Several threads may ask.
    std::vector<VertexHandle> vertex_members(SetHandle s) const;
    std::vector<CellHandle> cell_members(SetHandle s) const;
    std::vector<HalffaceHandle> face_members(SetHandle s) const;
    std::vector<std::pair<CellHandle, int>> edge_members(SetHandle s) const;
    ///@}

    ///@{
    /// The sets that an entity is in, as an interned number (0: none), and what the number stands for,
    /// ascending.
    CombinationId combination(VertexHandle v) const {
        return vertex_combinations_.empty() ? 0 : vertex_combinations_[v.idx()];
    }
    CombinationId combination(CellHandle c) const { return row(c).cell; }
    CombinationId combination(HalffaceHandle hf) const {
        return row(incident_cell(hf)).faces[local_face(hf)];
    }
    CombinationId combination(CellHandle c, int local_edge) const { return row(c).edges[local_edge]; }
    std::span<const SetHandle> sets_of(CombinationId id) const { return sets_.combination(id); }
    ///@}

  private:
    struct EdgeNumbers {
        std::vector<std::array<Index, 6>> of_cell;
        std::vector<Index> place;  ///< 8 * cell + local edge of one cell; `none` where the edge is gone
    };
    struct FaceNumbers {
        std::vector<std::array<Index, 4>> of_cell;
        std::vector<Index> halfface;  ///< one half-face; `none` where the face is gone
    };
    struct Split;
    struct SplitLocals;
    class UniformSplit;
    class Exchange;

    const NamedSets::Row& row(CellHandle c) const {
        return sets_.row(cell_rows_.empty() ? 0 : cell_rows_[c.idx()]);
    }
    template <class Change>
    void change_row(CellHandle c, const Change& change);
    void change_combination(SetHandle s, VertexHandle v, bool in);
    void change_combination(SetHandle s, CellHandle c, bool in);
    void change_combination(SetHandle s, HalffaceHandle hf, bool in);
    void change_combination(SetHandle s, CellHandle c, int local_edge, bool in);
    void require_kind(SetHandle s, EntityKind kind) const;
    template <class Add>
    void for_each_in_rows(EntityKind kind, const Add& add) const;
    void list_members(EntityKind kind, MemberLists::Lists& lists) const;
    template <class Use>
    auto with_members(SetHandle s, const Use& use) const;
    template <class Member, class Make>
    std::vector<Member> members(SetHandle s, EntityKind kind, const Make& make) const;

    template <class Entity, class T>
    Property<T>& values(PropertyHandle<Entity, T> ph) const;
    template <class Entity>
    static constexpr EntityKind kind_of();
    template <class Entity>
    PropertyList& list_of() const;
    template <class Entity>
    StatusBits* status_bits(Entity h) const;
    PropertyList& properties_of(EntityKind kind) const { return properties_[static_cast<int>(kind)]; }
    std::size_t n_indices(EntityKind kind) const;

    std::vector<Index> link(std::vector<Index> unlinked);
    std::vector<Index> boundary_sides() const;
    void find_vertex_cells();
    void find_pinches(std::span<const Index> boundary);
    void repair_fans(std::span<const VertexHandle> vertices, std::span<const CellList> cells_at);
    template <class Visit>
    void visit_fan(Index start, Index vertex, const Visit& visit) const;
    void append_ring(CellHandle c, int local_edge, CellList& ring) const;
    void number_remaining_edges() const;
    void number_remaining_faces() const;
    void number_new_cell(CellHandle c);
    void forget_numbers(CellHandle c);
    void inherit_sets_from_neighbors(CellHandle c);
    void append_sets(const TetMesh& other);
    void append_numbers(const TetMesh& other);
    void append_properties(const TetMesh& other);

    VertexHandle split_between(VertexHandle a, VertexHandle b, double ratio, const CellList& ring);
    SplitLocals locals_of(CellHandle c, VertexHandle a, VertexHandle b) const;
    void split_all(std::span<const Split> splits);
    void grow(std::size_t n_vertices, std::size_t n_cells);
    void split_cells(const Split& split);
    void link_to_others(const Split& split, Index first_vertex);
    void split_edge_numbers(const Split& split);
    void split_face_numbers(const Split& split);
    void split_pinches(const Split& split);
    void split_sets(const Split& split);
    Cavity look_into(const Retriangulation& change) const;
    void look_for_hinges(const Retriangulation& change, Cavity& cavity) const;
    void relink(const Retriangulation& change, Cavity& cavity);
    void give_rows(const Retriangulation& change, const Cavity& cavity);
    void pass_on_cell_values(const Retriangulation& change, const Cavity& cavity);
    void repair_hinges(const Retriangulation& change, Cavity& cavity);

    std::vector<CombinationId> prepare_sets(std::span<const Split> splits);
    template <class Sets>
    CombinationId plan_sets(Sets& sets, const Split& split) const;
    void apply_custom_rules(const Split& split);

    Column<Point> points_;
    Column<Cell> cells_;
    Column<Index> vertex_cells_;  ///< a cell of each vertex
    Index n_boundary_ = 0;

    /// Where the boundary isn't manifold: a cell of each further fan of a vertex, and of each fan of an edge
    /// (its ends packed, the lower one high).
    std::unordered_map<Index, std::vector<Index>> vertex_fans_;
    std::unordered_map<std::uint64_t, std::vector<Index>> edge_fans_;

    mutable std::optional<EdgeNumbers> edges_;
    mutable std::optional<FaceNumbers> faces_;
    std::vector<std::uint8_t> deleted_cells_, deleted_vertices_;  ///< empty where nothing is deleted

    mutable std::array<PropertyList, 4>
        properties_;  ///< by EntityKind; edges' and faces' grow when they are numbered
    mutable PropertyList mesh_properties_;
    std::array<std::uint32_t, 4> status_requests_{}, status_property_{};  ///< by EntityKind
    NamedSets sets_;
    Column<CombinationId> vertex_combinations_;  ///< empty while no vertex is in a set
    Column<NamedSets::RowId> cell_rows_;         ///< empty while no edge, face or cell is in a set
    mutable MemberLists members_;
};

inline std::array<Point, 4> TetMesh::cell_points(CellHandle c) const {
    const auto& v = cells_[c.idx()].vertices;
    return {points_[v[0]], points_[v[1]], points_[v[2]], points_[v[3]]};
}

inline std::array<VertexHandle, 4> TetMesh::cell_vertices(CellHandle c) const {
    const auto& v = cells_[c.idx()].vertices;
    return {VertexHandle(v[0]), VertexHandle(v[1]), VertexHandle(v[2]), VertexHandle(v[3])};
}

inline int TetMesh::local_vertex(CellHandle c, VertexHandle v) const {
    for (int i = 0; i < 4; ++i)
        if (cells_[c.idx()].vertices[i] == v.idx()) return i;
    return -1;
}

inline int TetMesh::local_edge(CellHandle c, VertexHandle a, VertexHandle b) const {
    const int i = local_vertex(c, a);
    const int j = local_vertex(c, b);
    return i < 0 || j < 0 || i == j ? -1 : tet::edge_between[i][j];
}

inline CellList TetMesh::cc_range(CellHandle c) const {
    CellList cells;
    for (Index other : cells_[c.idx()].neighbors)
        if (other != none) cells.push_back(CellHandle(other / 4));
    return cells;
}

}  // namespace maille::volmesh

#include "volmesh/smart_handles.hh"        // IWYU pragma: export
#include "volmesh/tet_mesh_properties.hh"  // IWYU pragma: export
#include "volmesh/tet_ranges.hh"           // IWYU pragma: export
