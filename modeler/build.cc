#include "modeler/build.hh"

#include <algorithm>
#include <iterator>

#include "modeler/build_points.hh"
#include "modeler/build_primitives.hh"
#include "modeler/build_projection.hh"
#include "modeler/build_size.hh"
#include "modeler/merge_operand.hh"
#include "modeler/phase_timer.hh"
#include "modeler/projector_touch.hh"
#include "modeler/trim.hh"
#include "volmesh/error.hh"

namespace maille::modeler {
namespace {

using volmesh::CellHandle;
using volmesh::EntityKind;
using volmesh::SetHandle;
using volmesh::TetMesh;

RemeshGeometry remesh_geometry(const Model& model, std::span<const Operand> operands) {
    std::vector<double> sizes;
    std::vector<ClosedSurface> tessellated;
    for (const Operand& operand : operands) {
        sizes.push_back(operand.size);
        tessellated.push_back(operand.surface);
    }
    const auto face = [numbered = surfaces(model), primitives = model.primitives](std::uint32_t surface) {
        return std::pair(primitives[numbered[surface].primitive].shape.get(), numbered[surface].face);
    };
    return {.project = surface_projection(model),
            .touch =
                [=, size = diagonal(model)](std::uint32_t a, std::uint32_t b, const Point& p) {
                    const auto [shape_a, face_a] = face(a);
                    const auto [shape_b, face_b] = face(b);
                    return touching_point({shape_a, face_a}, {shape_b, face_b}, p, size);
                },
            .normal =
                [=](std::uint32_t surface, const Point& p) {
                    const auto [shape, number] = face(surface);
                    return shape->face_normal(number, p);
                },
            .planar =
                [=](std::uint32_t surface) {
                    const auto [shape, number] = face(surface);
                    return shape->faces()[number].planar;
                },
            .size = SurfaceSize(model, sizes, tessellated)};
}

SetHandle named_set(TetMesh& mesh, const std::string& name, EntityKind kind) {
    const SetHandle known = mesh.find_set(name, kind);
    return known.is_valid() ? known : mesh.add_set(name, kind);
}

void name_cells(Merged& merged, const Model& model) {
    std::vector<std::vector<CellHandle>> cells(model.primitives.size());
    for (const CellHandle c : merged.mesh.cells()) cells[merged.region(c)].push_back(c);
    const auto name = [&](const std::string& set, std::size_t primitive) {
        merged.mesh.insert(named_set(merged.mesh, set, EntityKind::cell), cells[primitive]);
    };
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const Primitive& primitive = model.primitives[i];
        if (!cells[i].empty()) name(primitive.name, i);
        if (!cells[i].empty() && !primitive.material.empty()) name(primitive.material, i);
    }
}

void name_faces(Merged& merged, const Model& model) {
    TetMesh& mesh = merged.mesh;
    const std::vector<ModelSurface> numbered = surfaces(model);
    std::vector<std::array<SetHandle, 2>> sets(numbered.size());  // of the boundary, of inner faces
    const auto is_inner = [&](const InterfaceFace& face) { return !mesh.is_boundary(face.face); };
    const auto given_name = [&](const InterfaceFace& face) -> const std::string* {
        if (is_inner(face)) return nullptr;
        const std::uint32_t owner = merged.region(TetMesh::incident_cell(face.face));
        const auto& names = model.primitives[owner].boundary_names;
        const auto found = names.find(face.surface);
        return found == names.end() ? nullptr : &found->second;
    };
    for (const InterfaceFace& face : merged.faces)
        if (given_name(face) == nullptr) sets[face.surface][is_inner(face)] = SetHandle(0);
    for (std::size_t s = 0; s < sets.size(); ++s)
        for (const bool inner : {false, true})
            if (SetHandle& set = sets[s][inner]; set.is_valid())
                set = named_set(mesh, numbered[s].name + std::string(inner ? inner_suffix : ""),
                                EntityKind::face);
    for (const InterfaceFace& face : merged.faces)
        if (const std::string* name = given_name(face))
            mesh.insert(named_set(mesh, *name, EntityKind::face), face.face);
        else
            mesh.insert(sets[face.surface][is_inner(face)], face.face);
}

/// Whether to make anew the mesh that a merge takes from an operand costs less, as it is seldom needed again,
/// than always to copy it.
bool are_large(std::span<const Operand> operands) {
    return std::ranges::any_of(operands,
                               [](const Operand& operand) { return operand.mesh.n_cells() > 200'000; });
}

/// A mesh of the model, and what is to be told of it.
struct Attempt {
    Merged merged;
    quality::ProjectionResult projection;
    std::vector<std::string> warnings;
};

void add_mesh(Attempt& result, const Model& model, const BuildOptions& options, std::span<Operand> operands) {
    const auto n_surfaces = static_cast<std::uint32_t>(surfaces(model).size());
    result.merged = merge_operands(operands, model.tree, remesh_geometry(model, operands), n_surfaces,
                                   {.keep_cells = options.keep_cells,
                                    .time_limit = options.time_limit,
                                    .may_take_mesh = are_large(operands)},
                                   result.warnings);
    name_cells(result.merged, model);
    name_faces(result.merged, model);
    result.projection = project_new_vertices(result.merged, projector(model));
}

/// Adds the new points to those that there are; returns the primitives that have got any.
std::vector<std::size_t> append(std::vector<std::vector<FacePoint>>& points,
                                const std::vector<std::vector<FacePoint>>& more) {
    std::vector<std::size_t> changed;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (more[i].empty()) continue;
        points[i].insert(points[i].end(), more[i].begin(), more[i].end());
        changed.push_back(i);
    }
    return changed;
}

/// Where vertices are short of their surfaces, tries again with triangles that are on these there, some
/// times, as long as every other time leaves half of them at most. A further attempt takes as long as the
/// first: large models have none. `with_cells`: the operands that had a mesh.
void try_again(Attempt& best, const Model& model, const BuildOptions& options, const PrimitiveMesher& mesher,
               std::vector<Operand>& operands, std::span<const std::size_t> with_cells) {
    constexpr int most_times = 6, most_futile = 2;
    constexpr std::size_t most_faces = 100'000;
    if (best.merged.faces.size() > most_faces) return;
    std::vector<std::vector<FacePoint>> points(operands.size());
    PointsToMeet more = points_to_meet(model, operands, best.merged, best.projection.short_of_target);
    std::size_t fewest = more.n_vertices;
    for (int i = 0, futile = 0; i < most_times && futile < most_futile && fewest > 0; ++i) {
        auto changed = append(points, more.points);
        if (changed.empty()) return;
        for (const std::size_t operand : with_cells)
            if (operands[operand].mesh.n_cells() == 0) changed.push_back(operand);  // its mesh was taken
        std::ranges::sort(changed);
        changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
        try {
            Attempt next;
            if (!mesher.mesh_again(operands, changed, points, next.warnings)) return;
            add_mesh(next, model, options, operands);
            more = points_to_meet(model, operands, next.merged, next.projection.short_of_target);
            futile = 2 * more.n_vertices <= fewest ? 0 : futile + 1;
            if (more.n_vertices >= fewest) continue;
            fewest = more.n_vertices;
            best = std::move(next);
        } catch (const InputError&) {
            return;  // what there is already is as good as it gets
        }
    }
}

}  // namespace

TetMesh build(const Model& given, const BuildOptions& options, BuildReport* report) {
    BuildReport unwanted;
    BuildReport& told = report != nullptr ? *report : unwanted;
    if (given.primitives.empty()) throw InputError("the model is empty: it has no solids");
    const Model model = trimmed(given);
    const PrimitiveMesher mesher(model, options);
    std::vector<Operand> operands;
    {
        const PhaseTimer timer(told.primitives);
        operands = mesher.mesh(told);
    }
    const PhaseTimer timer(told.merge);
    std::vector<std::size_t> with_cells;
    for (std::size_t i = 0; i < operands.size(); ++i)
        if (operands[i].mesh.n_cells() > 0) with_cells.push_back(i);
    Attempt best;
    add_mesh(best, model, options, operands);
    try_again(best, model, options, mesher, operands, with_cells);
    std::ranges::move(best.warnings, std::back_inserter(told.warnings));
    told.projection = std::move(best.projection);
    told.kept_cells = best.merged.kept_cells.size();
    told.new_cells = best.merged.mesh.n_cells() - told.kept_cells;
    return std::move(best.merged.mesh);
}

}  // namespace maille::modeler
