#include <cmath>

#include <fmt/format.h>

#include "tools/convergence/cases.hh"
#include "volmesh/error.hh"
#include "volmesh/measure.hh"

namespace maille::convergence {
namespace {

double relative(double found, double exact) {
    return std::abs(found - exact) / exact;
}

double set_measure(const volmesh::TetMesh& mesh, const std::string& name) {
    const bool is_face_set = name.find('/') != std::string::npos;
    const auto set = mesh.find_set(name, is_face_set ? volmesh::EntityKind::face : volmesh::EntityKind::cell);
    if (!set.is_valid()) throw InputError(fmt::format("the mesh has no set {}", name));
    return measure(mesh, set);
}

}  // namespace

modeler::Model model_of(const Case& c, const std::filesystem::path& examples) {
    modeler::Model model = c.source.empty() ? modeler::read_model(examples / (c.name + ".csg"))
                                            : modeler::parse_model(c.source, c.name);
    for (modeler::Primitive& primitive : model.primitives) primitive.size = 0;
    return model;
}

Errors errors(const Case& c, const volmesh::TetMesh& mesh) {
    Errors result{relative(volume(mesh), c.volume), relative(boundary_area(mesh), c.area), 0, "-"};
    for (const auto& [name, exact] : c.sets)
        if (const double error = relative(set_measure(mesh, name), exact); error > result.worst_set) {
            result.worst_set = error;
            result.worst_set_name = name;
        }
    return result;
}

}  // namespace maille::convergence
