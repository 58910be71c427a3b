#include "modeler/build.hh"

#include <algorithm>
#include <iterator>

#include <fmt/core.h>

#include "modeler/build_copies.hh"
#include "modeler/build_projection.hh"
#include "modeler/build_size.hh"
#include "modeler/closed_surface.hh"
#include "modeler/merge_operand.hh"
#include "modeler/parallel.hh"
#include "modeler/phase_timer.hh"
#include "modeler/projector_touch.hh"
#include "modeler/shared_surface.hh"
#include "modeler/tessellate.hh"
#include "modeler/tetrahedralize.hh"
#include "volmesh/error.hh"

namespace maille::modeler {
namespace {

using volmesh::CellHandle;
using volmesh::EntityKind;
using volmesh::SetHandle;
using volmesh::TetMesh;

/// Of all primitives, also of what is cut off.
double diagonal(const Model& model) {
    Eigen::AlignedBox3d box;
    for (const Primitive& primitive : model.primitives) box.extend(primitive.shape->bounding_box());
    return box.diagonal().norm();
}

double default_size(const Model& model) {
    const Eigen::AlignedBox3d box = bounding_box(model);
    return (box.isEmpty() ? diagonal(model) : box.diagonal().norm()) / 20;
}

std::vector<double> sizes_of_primitives(const Model& model, const BuildOptions& options) {
    if (options.size < 0) throw InputError(fmt::format("the size has to be positive, not {}", options.size));
    const double general = options.size > 0 ? options.size : default_size(model);
    std::vector<double> sizes;
    for (const Primitive& primitive : model.primitives)
        sizes.push_back(primitive.size > 0 ? primitive.size : general);
    return sizes;
}

/// Marks the primitives that can own cells.
void mark_owners(const CsgTree& tree, std::vector<std::uint8_t>& marks) {
    const bool first_only =
        tree.operation == Operation::intersection || tree.operation == Operation::difference;
    if (tree.operation == Operation::leaf) marks[tree.primitive] = 1;
    for (const CsgTree& child : tree.children) {
        mark_owners(child, marks);
        if (first_only) return;
    }
}

/// The number of each primitive's first surface.
std::vector<std::uint32_t> first_surfaces(const Model& model) {
    std::vector<std::uint32_t> first(model.primitives.size());
    const std::vector<ModelSurface> numbered = surfaces(model);
    for (std::size_t s = numbered.size(); s-- > 0;)
        first[numbered[s].primitive] = static_cast<std::uint32_t>(s);
    return first;
}

/// Primitives that differ in place only are meshed once.
std::vector<Operand> mesh_primitives(const Model& model, const BuildOptions& options, BuildReport& report) {
    const std::size_t n = model.primitives.size();
    std::vector<double> sizes = sizes_of_primitives(model, options);
    const auto shared = find_shared_surfaces(model.primitives, sizes, options.chord_tolerance);
    const std::vector<std::uint32_t> first = first_surfaces(model);
    std::vector<std::uint8_t> may_own(n);
    mark_owners(model.tree, may_own);
    const std::vector<std::size_t> original = first_alike(model.primitives, sizes, shared);
    for (std::size_t i = 0; i < n; ++i) may_own[original[i]] |= may_own[i];
    std::vector<Operand> operands(n);
    std::vector<std::vector<std::string>> warnings_of(n);
    parallel_for(n, options.threads, [&](std::size_t i) {
        if (original[i] != i) return;
        const Primitive& primitive = model.primitives[i];
        Operand& operand = operands[i];
        operand.name = primitive.name;
        operand.size = sizes[i];
        const volmesh::TriMesh surface = tessellate(primitive, {.size = sizes[i],
                                                                .chord_tolerance = options.chord_tolerance,
                                                                .is_draft = !may_own[i],
                                                                .shared = shared[i]});
        operand.surface = closed_surface(surface, first[i]);
        if (!may_own[i] || !options.keep_cells) return;
        try {
            operand.mesh =
                tetrahedralize(surface, sizes[i], {.time_limit = options.time_limit, .name = primitive.name},
                               &warnings_of[i]);
        } catch (const InputError& error) {
            // It can still be meshed together with the others.
            warnings_of[i].push_back(error.what());
        }
    });
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t j = original[i];
        if (j == i) continue;
        operands[i] =
            moved_operand(operands[j], model.primitives[j], model.primitives[i], first[j], first[i]);
        if (!may_own[i]) operands[i].mesh = {};
        ++report.moved_primitives;
    }
    for (auto& list : warnings_of) std::ranges::move(list, std::back_inserter(report.warnings));
    return operands;
}

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

void name_cells(TetMesh& mesh, const std::vector<std::uint32_t>& regions, const Model& model) {
    std::vector<std::uint8_t> owns(model.primitives.size());
    for (const std::uint32_t region : regions) owns[region] = 1;
    std::vector<std::vector<SetHandle>> sets(model.primitives.size());
    for (std::size_t i = 0; i < sets.size(); ++i) {
        if (!owns[i]) continue;
        const Primitive& primitive = model.primitives[i];
        sets[i].push_back(named_set(mesh, primitive.name, EntityKind::cell));
        if (!primitive.material.empty())
            sets[i].push_back(named_set(mesh, primitive.material, EntityKind::cell));
    }
    std::vector<std::vector<CellHandle>> cells(model.primitives.size());
    for (const CellHandle c : mesh.cells()) cells[regions[c.idx()]].push_back(c);
    for (std::size_t i = 0; i < sets.size(); ++i)
        for (const SetHandle set : sets[i]) mesh.insert(set, cells[i]);
}

void name_faces(TetMesh& mesh, const std::vector<std::uint32_t>& regions,
                const std::vector<InterfaceFace>& faces, const Model& model) {
    const std::vector<ModelSurface> numbered = surfaces(model);
    std::vector<std::array<SetHandle, 2>> sets(numbered.size());  // of the boundary, of inner faces
    const auto is_inner = [&](const InterfaceFace& face) { return !mesh.is_boundary(face.face); };
    const auto given_name = [&](const InterfaceFace& face) -> const std::string* {
        if (is_inner(face)) return nullptr;
        const std::uint32_t owner = regions[TetMesh::incident_cell(face.face).idx()];
        const auto& names = model.primitives[owner].boundary_names;
        const auto found = names.find(face.surface);
        return found == names.end() ? nullptr : &found->second;
    };
    for (const InterfaceFace& face : faces)
        if (given_name(face) == nullptr) sets[face.surface][is_inner(face)] = SetHandle(0);
    for (std::size_t s = 0; s < sets.size(); ++s)
        for (const bool inner : {false, true})
            if (SetHandle& set = sets[s][inner]; set.is_valid())
                set = named_set(mesh, numbered[s].name + std::string(inner ? inner_suffix : ""),
                                EntityKind::face);
    for (const InterfaceFace& face : faces)
        if (const std::string* name = given_name(face))
            mesh.insert(named_set(mesh, *name, EntityKind::face), face.face);
        else
            mesh.insert(sets[face.surface][is_inner(face)], face.face);
}

}  // namespace

TetMesh build(const Model& model, const BuildOptions& options, BuildReport* report) {
    BuildReport unwanted;
    BuildReport& told = report != nullptr ? *report : unwanted;
    if (model.primitives.empty()) throw InputError("the model is empty: it has no solids");
    std::vector<Operand> operands;
    {
        const PhaseTimer timer(told.primitives);
        operands = mesh_primitives(model, options, told);
    }
    const PhaseTimer timer(told.merge);
    const auto n_surfaces = static_cast<std::uint32_t>(surfaces(model).size());
    Merged merged =
        merge_operands(operands, model.tree, remesh_geometry(model, operands), n_surfaces,
                       {.keep_cells = options.keep_cells, .time_limit = options.time_limit}, told.warnings);
    told.kept_cells = merged.kept_cells.size();
    told.new_cells = merged.mesh.n_cells() - told.kept_cells;
    name_cells(merged.mesh, merged.regions, model);
    name_faces(merged.mesh, merged.regions, merged.faces, model);
    told.projection = project_new_vertices(merged, projector(model));
    return std::move(merged.mesh);
}

}  // namespace maille::modeler
