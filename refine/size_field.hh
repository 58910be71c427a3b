#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

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

/// The size that an expression of x, y, z and r, the distance from the origin, gives:
/// `0.02+0.2*(1-exp(-r/0.3))`. Throws InputError in plain words, with the place in the text, where it can't
/// be read.
SizeField parse_size(const std::string& expression);

/// The smallest of several sizes at each point. Precondition: at least one.
SizeField minimum(std::vector<SizeField> fields);

/// The size that a mesh carries as a property of real numbers: of its vertices, linear in each cell, or of
/// its cells. Outside the mesh it is that of the nearest point of the mesh. The field keeps a copy of what it
/// needs of the mesh. Throws InputError where the mesh has no cell or no such property, or a value is not
/// positive and finite.
SizeField mesh_size(const volmesh::TetMesh& mesh, const std::string& property);

}  // namespace maille::refine
