#include "modeler/merge_sets.hh"

#include <string>

#include "modeler/model.hh"

namespace maille::modeler {
namespace {

using volmesh::CellHandle;
using volmesh::CombinationId;
using volmesh::EntityKind;
using volmesh::HalffaceHandle;
using volmesh::SetHandle;
using volmesh::SetInfo;
using volmesh::SetRule;
using volmesh::TetMesh;
using volmesh::VertexHandle;

class SetCarrier {
  public:
    SetCarrier(std::span<const TetMesh> meshes, const MeshRegions& regions, Merged& merged)
        : meshes_(meshes), regions_(regions), merged_(merged) {}

    void carry_cells() {
        std::vector<std::vector<CellHandle>> cells_of(regions_.regions.size());
        std::vector<std::uint32_t> order;  // of regions, as they first appear
        for (const CellHandle c : merged_.mesh.cells()) {
            const std::uint32_t region = merged_.region(c);
            if (cells_of[region].empty()) order.push_back(region);
            cells_of[region].push_back(c);
        }
        for (const std::uint32_t number : order) {
            const MeshRegion& region = regions_.regions[number];
            const TetMesh& from = meshes_[region.mesh];
            for (const SetHandle set : from.sets_of(from.combination(region.cells.front())))
                merged_.mesh.insert(same_set(from, set), cells_of[number]);
        }
    }

    void carry_surfaces() {
        for (const InterfaceFace& face : merged_.faces) {
            const MeshSurface& surface = regions_.surfaces[face.surface];
            const TetMesh& from = meshes_[surface.mesh];
            const bool was_inner = !from.is_boundary(surface.example),
                       is_inner = !merged_.mesh.is_boundary(face.face);
            for (const SetHandle set : from.sets_of(from.combination(surface.example)))
                merged_.mesh.insert(
                    set_named(from, set, name_for(from.set_info(set).name, was_inner, is_inner)), face.face);
        }
    }

    /// What is inside a region is known only where its cells are kept.
    void carry_kept() {
        for (std::uint32_t c = 0; const Origin& origin : merged_.kept_cells.origins()) {
            const MeshRegion& region = regions_.regions[origin.operand];
            carry_insides(meshes_[region.mesh], region.cells[origin.index], CellHandle(c++));
        }
        for (std::uint32_t v = 0; const Origin& origin : merged_.kept_vertices.origins()) {
            const MeshRegion& region = regions_.regions[origin.operand];
            const TetMesh& from = meshes_[region.mesh];
            for (const SetHandle set : from.sets_of(from.combination(region.vertices[origin.index])))
                merged_.mesh.insert(same_set(from, set), VertexHandle(v));
            ++v;
        }
    }

  private:
    /// Faces and edges of a kept cell, which has its vertices in the same order.
    void carry_insides(const TetMesh& from, CellHandle old_cell, CellHandle cell) {
        TetMesh& mesh = merged_.mesh;
        for (int k = 0; k < 4; ++k) {
            const HalffaceHandle old_face = TetMesh::halfface(old_cell, k), face = TetMesh::halfface(cell, k);
            if (from.combination(old_face) == 0 || is_on_surface(from, old_face)) continue;
            for (const SetHandle set : from.sets_of(from.combination(old_face)))
                mesh.insert(same_set(from, set), face);
        }
        for (int e = 0; e < 6; ++e)
            for (const SetHandle set : from.sets_of(from.combination(old_cell, e)))
                mesh.insert(same_set(from, set), cell, e);
    }

    static std::string name_for(const std::string& name, bool was_inner, bool is_inner) {
        if (was_inner == is_inner) return name;
        if (is_inner) return name + std::string(inner_suffix);
        return name.ends_with(inner_suffix) ? name.substr(0, name.size() - inner_suffix.size()) : name;
    }

    SetHandle same_set(const TetMesh& from, SetHandle set) {
        return set_named(from, set, from.set_info(set).name);
    }

    SetHandle set_named(const TetMesh& from, SetHandle set, const std::string& name) {
        const SetInfo& info = from.set_info(set);
        const SetHandle known = merged_.mesh.find_set(name, info.kind);
        if (known.is_valid()) return known;
        SetRule rule = info.rule;
        if (rule.source.is_valid()) rule.source = same_set(from, rule.source);
        return merged_.mesh.add_set(name, info.kind, rule);
    }

    std::span<const TetMesh> meshes_;
    const MeshRegions& regions_;
    Merged& merged_;
};

}  // namespace

void carry_sets_over(std::span<const TetMesh> meshes, const MeshRegions& regions, Merged& merged) {
    SetCarrier carrier(meshes, regions, merged);
    carrier.carry_cells();
    carrier.carry_surfaces();
    carrier.carry_kept();
}

}  // namespace maille::modeler
