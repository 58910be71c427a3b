#include "volmesh/strata.hh"

#include <algorithm>
#include <utility>

namespace maille::volmesh {
namespace {

/// An edge from a vertex, with what is met at it.
struct Spoke {
    VertexHandle to;
    CombinationId sets;
    std::uint32_t n_sheets = 0;
    HalffaceHandle first_sheet{};
    bool is_one_patch = true;
    VertexHandle across[2]{};  ///< the third vertices of the first two sheets

    bool is_curve() const { return sets != 0 || (n_sheets != 0 && (n_sheets != 2 || !is_one_patch)); }
};

using Spokes = boost::container::small_vector<Spoke, 32>;

Spoke& spoke_to(Spokes& spokes, VertexHandle v, CombinationId sets) {
    for (Spoke& spoke : spokes)
        if (spoke.to == v) return spoke;
    spokes.push_back({v, sets});
    return spokes.back();
}

/// The spokes at v that lie on interfaces or in edge sets.
Spokes marked_spokes(const TetMesh& mesh, VertexHandle v, const CellList& cells) {
    Spokes spokes;
    for (CellHandle c : cells) {
        const int at = mesh.local_vertex(c, v);
        for (int i = 0; i < 4; ++i) {
            if (i == at) continue;
            const int edge = tet::edge_between[at][i];
            if (const CombinationId sets = mesh.combination(c, edge); sets != 0)
                spoke_to(spokes, mesh.cell_vertex(c, i), sets);
            const HalffaceHandle hf = TetMesh::halfface(c, i);
            const HalffaceHandle beyond = mesh.opposite_halfface_handle(hf);
            if ((beyond.is_valid() && beyond < hf) || !is_interface(mesh, hf)) continue;
            const int j = i == 0 ? (at == 1 ? 2 : 1) : (at == 0 ? (i == 1 ? 2 : 1) : 0);
            const int k = 6 - at - i - j;
            for (const auto& [to, other] : {std::pair(j, k), std::pair(k, j)}) {
                Spoke& spoke =
                    spoke_to(spokes, mesh.cell_vertex(c, to), mesh.combination(c, tet::edge_between[at][to]));
                if (spoke.n_sheets == 0)
                    spoke.first_sheet = hf;
                else if (!is_same_patch(mesh, spoke.first_sheet, hf))
                    spoke.is_one_patch = false;
                if (spoke.n_sheets < 2) spoke.across[spoke.n_sheets] = mesh.cell_vertex(c, other);
                ++spoke.n_sheets;
            }
        }
    }
    return spokes;
}

/// Whether the sheets at a vertex, two at each spoke, are one fan.
bool is_one_fan(const Spokes& spokes) {
    VertexHandle before = spokes.front().to;
    VertexHandle at = spokes.front().across[0];
    std::size_t length = 1;
    while (at != spokes.front().to && length <= spokes.size()) {
        const auto spoke = std::ranges::find(spokes, at, &Spoke::to);
        const VertexHandle next = spoke->across[0] == before ? spoke->across[1] : spoke->across[0];
        before = std::exchange(at, next);
        ++length;
    }
    return length == spokes.size();
}

}  // namespace

bool is_interface(const TetMesh& mesh, HalffaceHandle hf) {
    const HalffaceHandle beyond = mesh.opposite_halfface_handle(hf);
    return !beyond.is_valid() || mesh.combination(hf) != 0 ||
           mesh.combination(TetMesh::incident_cell(hf)) != mesh.combination(TetMesh::incident_cell(beyond));
}

bool is_same_patch(const TetMesh& mesh, HalffaceHandle one, HalffaceHandle other) {
    constexpr CombinationId outside = ~CombinationId{0};
    const auto sides = [&](HalffaceHandle hf) {
        const HalffaceHandle beyond = mesh.opposite_halfface_handle(hf);
        return std::minmax({mesh.combination(TetMesh::incident_cell(hf)),
                            beyond.is_valid() ? mesh.combination(TetMesh::incident_cell(beyond)) : outside});
    };
    return mesh.combination(one) == mesh.combination(other) && sides(one) == sides(other);
}

int stratum(const TetMesh& mesh, VertexHandle v, const CellList& cells) {
    if (mesh.combination(v) != 0) return 0;
    const Spokes spokes = marked_spokes(mesh, v, cells);
    if (spokes.empty()) return 3;
    boost::container::small_vector<const Spoke*, 4> curves;
    for (const Spoke& spoke : spokes)
        if (spoke.is_curve()) curves.push_back(&spoke);
    if (curves.empty()) return is_one_fan(spokes) ? 2 : 0;
    const bool goes_on = curves.size() == 2 && curves[0]->sets == curves[1]->sets &&
                         curves[0]->n_sheets == curves[1]->n_sheets;
    return goes_on ? 1 : 0;
}

int stratum(const TetMesh& mesh, VertexHandle v) {
    return stratum(mesh, v, mesh.vc_range(v));
}

int stratum(const TetMesh& mesh, CellHandle c, int local_edge) {
    if (mesh.combination(c, local_edge) != 0) return 1;
    std::size_t n_sheets = 0;
    HalffaceHandle first;
    bool is_one_patch = true;
    for (HalffaceHandle hf : mesh.halffaces_around(c, local_edge)) {
        if (!is_interface(mesh, hf)) continue;
        if (n_sheets++ == 0)
            first = hf;
        else if (!is_same_patch(mesh, first, hf))
            is_one_patch = false;
    }
    if (n_sheets == 0) return 3;
    return n_sheets == 2 && is_one_patch ? 2 : 1;
}

}  // namespace maille::volmesh
