#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "volmesh/projector.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::refine {

using volmesh::Point;

/// The wanted edge length at each point. A cheap value: copies share what they are made of. Thread-safe.
class SizeField {
  public:
    /// The same length everywhere. Throws InputError where it is not positive and finite.
    explicit SizeField(double length);
    /// Any function of the point; it must be thread-safe. `name` is what messages call it.
    explicit SizeField(std::function<double(const Point&)> function, std::string name = "the size function");

    /// Throws InputError, naming the place, where the size is not positive and finite.
    double operator()(const Point& p) const;

  private:
    struct Source {
        std::function<double(const Point&)> function;
        std::string name;
    };
    std::shared_ptr<const Source> source_;
};

/// What an expression of a size may speak of besides the point. Nothing of it is needed once it has been
/// read, but the projector's functions, which are kept.
struct SizeContext {
    const volmesh::TetMesh* mesh = nullptr;         ///< whose sets `d` measures to
    const volmesh::Projector* projector = nullptr;  ///< whose surfaces `curvature` asks for
};

/// The size that an expression of x, y, z and r, the distance from the origin, gives:
/// `0.02+0.2*(1-exp(-r/0.3))`.
///
/// With a mesh, `d('hole/side')` is the distance to the members of the sets of that name (`set_distance`);
/// with a projector too, `curvature(20)` the size that gives a circle on the curved surfaces 20 segments
/// (`curvature_size`). Throws InputError in plain words, with the place in the text, where it can't be read.
SizeField parse_size(const std::string& expression, const SizeContext& context = {});

/// Throws what `parse_size` would, but for sets and surfaces, which need not be known yet.
void check_size(const std::string& expression);

/// The smallest of several sizes at each point. Precondition: at least one.
SizeField minimum(std::vector<SizeField> fields);

/// How a size given by cell is meant: as the same all over the cell, or, as in the paper (section 3.3,
/// "Refinement information"), as a density that is weighted by the cells' volumes and averaged at each vertex
/// over the cells round it, and then linear in each cell.
enum class CellValues : std::uint8_t { constant, averaged };

/// The size that a mesh carries as a property of real numbers: of its vertices, linear in each cell, or of
/// its cells. Outside the mesh it is that of the nearest point of the mesh. The field keeps a copy of what it
/// needs of the mesh. Throws InputError where the mesh has no cell or no such property, or a value is not
/// positive and finite.
SizeField mesh_size(const volmesh::TetMesh& mesh, const std::string& property,
                    CellValues cell_values = CellValues::constant);

/// The exact distance to the nearest member of the sets of that name, of whichever kind: vertices, edges,
/// faces, and cells, inside which it is 0. It is measured to the mesh as it is now, and keeps a copy of what
/// it needs of it; thread-safe. Throws InputError where the mesh has no such set, naming those that it has,
/// or only empty ones.
std::function<double(const Point&)> set_distance(const volmesh::TetMesh& mesh, const std::string& name);

/// The size that gives a circle of the curved surfaces `segments` edges, growing by the distance from them:
/// the least, over the surfaces that faces of the mesh lie on, of 2 R sin(pi / segments) + |p - q|, where q
/// is the point of those faces nearest to p and R the surface's least radius of curvature there.
///
/// The first term is never below 1/10,000 of the model's size, for the sake of cones' tips, nor the sum above
/// the model's size. The mesh is taken as it is now, the projector's function kept; thread-safe. Throws
/// InputError where `segments` is less than 3 or the projector doesn't tell curvatures.
std::function<double(const Point&)> curvature_size(const volmesh::TetMesh& mesh,
                                                   const volmesh::Projector& projector, double segments);

/// The size, made to grow by no more than `growth` for each unit of length between vertices of the mesh:
///     min(size(p), min over the sources s of size(s) + growth * |p - s|),
/// the sources being the vertices with a neighbour in the mesh at which the size is larger than that allows.
///
/// The mesh should be as fine as the size wants it, so that its vertices see what the size does. It is taken
/// as it is now. Throws InputError where the growth is not positive and finite.
SizeField limit_growth(const SizeField& size, const volmesh::TetMesh& mesh, double growth);

}  // namespace maille::refine
