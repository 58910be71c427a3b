#include "tools/maille/mesh_info.hh"

#include <algorithm>

#include <fmt/format.h>

#include "volmesh/measure.hh"

namespace maille::tools {
namespace {

using volmesh::EntityKind;
using volmesh::TetMesh;

std::string_view name_of(EntityKind kind) {
    constexpr std::string_view names[] = {"vertex", "edge", "face", "cell"};
    return names[static_cast<std::size_t>(kind)];
}

std::size_t count_components(const TetMesh& mesh) {
    std::vector<bool> is_reached(mesh.n_cells(), false);
    std::vector<volmesh::CellHandle> front;
    const auto reach = [&](volmesh::CellHandle c) {
        if (is_reached[c.idx()]) return;
        is_reached[c.idx()] = true;
        front.push_back(c);
    };
    std::size_t components = 0;
    for (const volmesh::CellHandle seed : mesh.cells()) {
        if (is_reached[seed.idx()]) continue;
        ++components;
        reach(seed);
        while (!front.empty()) {
            const volmesh::CellHandle c = front.back();
            front.pop_back();
            for (const volmesh::CellHandle neighbor : mesh.cc_range(c)) reach(neighbor);
        }
    }
    return components;
}

std::vector<MeshInfo::Set> sets_of(const TetMesh& mesh) {
    std::vector<MeshInfo::Set> sets;
    for (std::uint32_t i = 0; i < mesh.n_sets(); ++i) {
        const volmesh::SetHandle set(i);
        sets.push_back({.name = mesh.set_info(set).name,
                        .kind = mesh.set_info(set).kind,
                        .size = mesh.set_size(set),
                        .measure = volmesh::measure(mesh, set)});
    }
    std::ranges::stable_sort(sets, std::ranges::greater{}, &MeshInfo::Set::kind);
    return sets;
}

}  // namespace

MeshInfo mesh_info(const TetMesh& mesh) {
    MeshInfo info{.vertices = mesh.n_vertices(),
                  .edges = mesh.n_edges(),
                  .faces = mesh.n_faces(),
                  .cells = mesh.n_cells(),
                  .boundary_faces = mesh.n_boundary_faces(),
                  .volume = volmesh::volume(mesh),
                  .area = volmesh::boundary_area(mesh),
                  .bbox = {},
                  .components = count_components(mesh),
                  .euler = 0,
                  .sets = sets_of(mesh)};
    for (const volmesh::Point& p : mesh.points()) info.bbox.extend(p);
    info.euler = std::int64_t{info.vertices} - info.edges + info.faces - info.cells;
    return info;
}

nlohmann::ordered_json to_json(const MeshInfo& info) {
    const auto point = [](const volmesh::Point& p) { return nlohmann::ordered_json{p.x(), p.y(), p.z()}; };
    nlohmann::ordered_json json{{"vertices", info.vertices},
                                {"edges", info.edges},
                                {"faces", info.faces},
                                {"cells", info.cells},
                                {"boundary_faces", info.boundary_faces},
                                {"volume", info.volume},
                                {"area", info.area},
                                {"bbox", {point(info.bbox.min()), point(info.bbox.max())}},
                                {"components", info.components},
                                {"euler", info.euler},
                                {"sets", nlohmann::ordered_json::array()}};
    for (const MeshInfo::Set& set : info.sets)
        json["sets"].push_back(
            {{"name", set.name}, {"kind", name_of(set.kind)}, {"size", set.size}, {"measure", set.measure}});
    return json;
}

std::string to_text(const MeshInfo& info) {
    const auto& low = info.bbox.min();
    const auto& high = info.bbox.max();
    std::string text = fmt::format(
        "vertices        {}\nedges           {}\nfaces           {}\ncells           {}\nboundary faces  {}\n"
        "volume          {:.10g}\narea            {:.10g}\n"
        "bounding box    [{:.6g}, {:.6g}] x [{:.6g}, {:.6g}] x [{:.6g}, {:.6g}]\n"
        "components      {}\nEuler number    {}\n",
        info.vertices, info.edges, info.faces, info.cells, info.boundary_faces, info.volume, info.area,
        low.x(), high.x(), low.y(), high.y(), low.z(), high.z(), info.components, info.euler);
    if (info.sets.empty()) return text;
    std::size_t width = 0;
    for (const MeshInfo::Set& set : info.sets) width = std::max(width, set.name.size());
    text += fmt::format("\n{:<{}}  {:<6}  {:>10}  {:>16}\n", "set", width, "kind", "size", "measure");
    for (const MeshInfo::Set& set : info.sets)
        text += fmt::format("{:<{}}  {:<6}  {:>10}  {:>16.10g}\n", set.name, width, name_of(set.kind),
                            set.size, set.measure);
    return text;
}

}  // namespace maille::tools
