#pragma once

#include <limits>
#include <span>

#include "modeler/facet_complex.hh"
#include "modeler/remesh_tree.hh"

namespace maille::modeler::remeshing {

inline constexpr Index none = std::numeric_limits<Index>::max();

/// A connected piece of one surface between the same two regions.
struct Patch {
    std::uint32_t surface;
    Region front;
    Region back;
    bool frozen;
    bool planar;
    double sense;  ///< 1 where its triangles' normals agree with those of the surface, else -1
};

/// How freely a vertex moves.
enum class VertexKind : std::uint8_t {
    face,     ///< on one surface
    curve,    ///< on the curve where surfaces cross
    tangent,  ///< on a curve along which the surfaces touch or coincide: only its vertices say where it runs
    corner    ///< where curves end, branch or turn, at the apex of a surface, or frozen: it stays
};

struct Triangle {
    std::array<Index, 3> vertices;
    Index patch;  ///< `none` in a triangle that is no more
};

/// Triangles that give way to others, and a vertex that takes a new place with it.
struct Change {
    std::vector<Index> removed;
    std::vector<Triangle> added;
    Index moved = none;
    Vec3 position = Vec3::Zero();
    /// Tetrahedra that the sheets sweep over. Nothing else may be in there.
    std::vector<std::array<Vec3, 4>> swept;
};

/// The complex while it is worked at: triangles, what they meet in, and where they are. It need not be
/// manifold.
class Net {
  public:
    /// Sets all patches, and which one each triangle belongs to.
    void set_patches(std::vector<Patch> patches, std::span<const Index> patch_of);
    Index add_vertex(const Vec3& point, VertexKind kind, double size);
    /// Takes back the last vertex, which no triangle may use.
    void drop_last_vertex();
    void add_triangle(const Triangle& triangle);
    /// Replaces triangles and moves the vertex. Numbers of removed triangles are used again.
    void apply(const Change& change);
    /// Packs the look-up of places, which many changes make slower.
    void pack_tree();

    Index n_vertices() const { return static_cast<Index>(points_.size()); }
    Index n_triangles() const { return static_cast<Index>(triangles_.size()); }
    const Vec3& point(Index v) const { return points_[v]; }
    VertexKind kind(Index v) const { return kinds_[v]; }
    void set_kind(Index v, VertexKind kind) { kinds_[v] = kind; }
    /// The wanted length of edges at the vertex.
    double size(Index v) const { return sizes_[v]; }
    void set_size(Index v, double size);

    /// Counts the changes.
    std::uint64_t now() const { return now_; }
    /// The last change of the triangles or the size at the vertex.
    std::uint64_t touched(Index v) const { return touched_[v]; }

    bool is_alive(Index t) const { return triangles_[t].patch != none; }
    const Triangle& triangle(Index t) const { return triangles_[t]; }
    const Patch& patch(Index t) const { return patch(triangles_[t]); }
    const Patch& patch(const Triangle& triangle) const { return patches_[triangle.patch]; }
    Corners corners(Index t) const;
    const TriangleTree& tree() const { return tree_; }

    std::span<const Index> triangles_at(Index v) const { return around_[v]; }
    std::vector<Index> triangles_at(Index a, Index b) const;
    /// Vertices that share an edge with v, in rising order.
    std::vector<Index> neighbours(Index v) const;
    bool has_edge(Index a, Index b) const;
    /// Whether the edge bounds a patch: other than two triangles meet there, or two of different patches.
    bool is_feature(Index a, Index b) const;
    /// The other ends of the feature edges at v, in rising order.
    std::vector<Index> feature_neighbours(Index v) const;
    /// All edges, smaller end first, in rising order.
    std::vector<std::array<Index, 2>> edges() const;
    /// Numbers of the surfaces of the triangles, in rising order.
    std::vector<std::uint32_t> surfaces(std::span<const Index> triangles) const;

    double length(Index a, Index b) const { return (points_[a] - points_[b]).norm(); }
    /// The wanted length of the edge.
    double wanted_length(Index a, Index b) const { return (sizes_[a] + sizes_[b]) / 2; }

  private:
    void attach(Index t);
    void detach(Index t);

    std::vector<Patch> patches_;
    std::vector<Vec3> points_;
    std::vector<VertexKind> kinds_;
    std::vector<double> sizes_;
    std::vector<std::uint64_t> touched_;
    std::uint64_t now_ = 0;
    std::vector<Triangle> triangles_;
    std::vector<std::vector<Index>> around_;
    std::vector<Index> unused_;  // numbers of removed triangles
    TriangleTree tree_;
};

/// The vertex of the triangle that is neither a nor b.
Index apex(const Triangle& triangle, Index a, Index b);
/// Whether the triangle runs from a to b.
bool runs_along(const Triangle& triangle, Index a, Index b);
bool contains(const Triangle& triangle, Index v);
/// The triangle with one vertex replaced.
Triangle replaced(Triangle triangle, Index from, Index to);

}  // namespace maille::modeler::remeshing
