#include "volmesh/fans.hh"

namespace maille::volmesh {

std::vector<std::uint32_t> first_cells_of_fans(const TetMesh& mesh, const CellList& cells,
                                               std::span<const VertexHandle> hinge) {
    std::vector<CellHandle> left(cells.begin(), cells.end());
    std::ranges::sort(left);
    std::vector<std::uint32_t> firsts;
    std::vector<CellHandle> fan;
    while (!left.empty()) {
        firsts.push_back(left.front().idx());
        fan.assign(1, left.front());
        left.erase(left.begin());
        while (!fan.empty()) {
            const CellHandle c = fan.back();
            fan.pop_back();
            for (int f = 0; f < 4; ++f) {
                if (std::ranges::find(hinge, mesh.cell_vertex(c, f)) != hinge.end()) continue;
                const HalffaceHandle other = mesh.opposite_halfface_handle(TetMesh::halfface(c, f));
                if (!other.is_valid()) continue;
                const auto place = std::ranges::lower_bound(left, TetMesh::incident_cell(other));
                if (place == left.end() || *place != TetMesh::incident_cell(other)) continue;
                fan.push_back(*place);
                left.erase(place);
            }
        }
    }
    return firsts;
}

}  // namespace maille::volmesh
