#include <cmath>
#include <set>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "refine/simplex_tree.hh"
#include "refine/size_field.hh"
#include "volmesh/error.hh"

namespace maille::refine {
namespace {

using volmesh::EntityKind;
using volmesh::SetHandle;
using volmesh::TetMesh;

constexpr EntityKind kinds[] = {EntityKind::vertex, EntityKind::edge, EntityKind::face, EntityKind::cell};

void add_members(std::vector<Simplex>& simplices, const TetMesh& mesh, SetHandle set) {
    const auto add = [&](const auto&... vertices) {
        simplices.push_back({{mesh.point(vertices)...}, sizeof...(vertices)});
    };
    switch (mesh.set_info(set).kind) {
        case EntityKind::vertex:
            for (const auto v : mesh.vertex_members(set)) add(v);
            break;
        case EntityKind::edge:
            for (const auto& [cell, edge] : mesh.edge_members(set)) {
                const auto [i, j] = volmesh::tet::edge_vertices[edge];
                add(mesh.cell_vertex(cell, i), mesh.cell_vertex(cell, j));
            }
            break;
        case EntityKind::face:
            for (const auto face : mesh.face_members(set)) std::apply(add, mesh.halfface_vertices(face));
            break;
        case EntityKind::cell:
            for (const auto cell : mesh.cell_members(set)) std::apply(add, mesh.cell_vertices(cell));
            break;
    }
}

[[noreturn]] void refuse_unknown(const TetMesh& mesh, const std::string& name) {
    std::set<std::string> known;
    for (std::uint32_t i = 0; i < mesh.n_sets(); ++i) known.insert(mesh.set_info(SetHandle(i)).name);
    constexpr std::size_t most = 20;
    std::vector<std::string> listed;
    for (const std::string& each : known)
        if (listed.size() < most) listed.push_back(each);
    throw InputError(fmt::format("the mesh has no set named \"{}\"; {}{}{}", name,
                                 known.empty() ? "it has no sets" : "its sets are ", fmt::join(listed, ", "),
                                 known.size() > most ? ", ..." : ""));
}

}  // namespace

std::function<double(const Point&)> set_distance(const TetMesh& mesh, const std::string& name) {
    std::vector<Simplex> members;
    bool is_known = false;
    for (const EntityKind kind : kinds) {
        const SetHandle set = mesh.find_set(name, kind);
        if (!set.is_valid()) continue;
        is_known = true;
        add_members(members, mesh, set);
    }
    if (!is_known) refuse_unknown(mesh, name);
    if (members.empty())
        throw InputError(fmt::format("there is no distance to the set \"{}\": it is empty", name));
    return [tree = SimplexTree(std::move(members))](const Point& p) {
        return std::sqrt(tree.nearest(p).squared_distance);
    };
}

}  // namespace maille::refine
