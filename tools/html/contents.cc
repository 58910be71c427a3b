#include "tools/html/contents.hh"

#include <map>

#include "tools/html/grid.hh"
#include "tools/html/quantities.hh"
#include "tools/html/selection.hh"
#include "volmesh/measure.hh"
#include "volmesh/tet_topology.hh"

namespace maille::html {
namespace {

using volmesh::CellHandle;
using volmesh::CombinationId;
using volmesh::EntityKind;
using volmesh::SetHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;
using Json = nlohmann::ordered_json;
using Numbers = std::vector<std::uint32_t>;

/// Numbers things in the order in which they are met.
class FirstUse {
  public:
    explicit FirstUse(std::size_t n) : number_(n, TetMesh::none) {}

    std::uint32_t number(std::uint32_t thing) {
        if (number_[thing] == TetMesh::none) {
            number_[thing] = static_cast<std::uint32_t>(order_.size());
            order_.push_back(thing);
        }
        return number_[thing];
    }
    const Numbers& order() const { return order_; }

  private:
    Numbers number_, order_;
};

/// The combinations of sets that the page's cells and faces have; number 0 is no set.
class Combinations {
  public:
    std::uint32_t number(const TetMesh& mesh, CombinationId id) {
        const auto [place, is_new] = numbers_.try_emplace(id, static_cast<std::uint32_t>(sets_.size()));
        if (is_new) {
            Json sets = Json::array();
            for (const SetHandle set : mesh.sets_of(id)) sets.push_back(set.idx());
            sets_.push_back(std::move(sets));
        }
        return place->second;
    }
    const Json& sets() const { return sets_; }

  private:
    std::map<CombinationId, std::uint32_t> numbers_{{CombinationId{0}, 0}};
    Json sets_ = Json::array({Json::array()});
};

Json quantities_json(const std::vector<Quantity>& quantities) {
    Json list = Json::array();
    for (const Quantity& q : quantities)
        list.push_back({{"name", q.name},
                        {"unit", q.unit},
                        {"low", q.low},
                        {"high", q.high},
                        {"best", q.best},
                        {"min", q.statistics.min},
                        {"mean", q.statistics.mean},
                        {"max", q.statistics.max},
                        {"histogram", q.statistics.histogram}});
    return list;
}

Json selection_json(const Selection& selection) {
    return {{"whole", selection.is_whole},
            {"cells", selection.cells.size()},
            {"worst", selection.n_worst},
            {"cuts", selection.cuts}};
}

std::vector<CellHandle> listed_cells(const quality::Report& report) {
    std::vector<CellHandle> cells;
    for (const quality::WorstCell& worst : report.worst) cells.push_back(worst.cell);
    if (report.critical)
        for (const quality::WorstCell& worst : report.critical->worst) cells.push_back(worst.cell);
    return cells;
}

void add_cells(Contents& contents, const TetMesh& mesh, const Selection& selection,
               const std::vector<Quantity>& quantities, FirstUse& points) {
    Combinations combinations;
    Numbers corners, cell_sets, faces;
    for (const std::uint32_t i : selection.cells) {
        const CellHandle c(i);
        for (const VertexHandle v : mesh.cell_vertices(c)) corners.push_back(points.number(v.idx()));
        cell_sets.push_back(combinations.number(mesh, mesh.combination(c)));
        for (int k = 0; k < 4; ++k) {
            const auto hf = TetMesh::halfface(c, k);
            const std::uint32_t sets = combinations.number(mesh, mesh.combination(hf));
            faces.push_back(2 * sets + (mesh.is_boundary(hf) ? 1 : 0));
        }
    }
    contents.blob.add_by_first_use("corners", corners);
    contents.blob.add_differences("numbers", selection.cells, 1);
    contents.blob.add("cell_sets", cell_sets);
    contents.blob.add("faces", faces);
    for (const Quantity& quantity : quantities) {
        Numbers codes;
        for (const std::uint32_t i : selection.cells) codes.push_back(quantity.codes[i]);
        contents.blob.add("code " + quantity.name, codes);
    }
    contents.figures["combinations"] = combinations.sets();
}

/// The vertices, or ends of edges, of a set of these.
Numbers members(const TetMesh& mesh, SetHandle set) {
    Numbers vertices;
    if (mesh.set_info(set).kind == EntityKind::vertex)
        for (const VertexHandle v : mesh.vertex_members(set)) vertices.push_back(v.idx());
    if (mesh.set_info(set).kind == EntityKind::edge)
        for (const auto& [cell, edge] : mesh.edge_members(set))
            for (int end : volmesh::tet::edge_vertices[edge])
                vertices.push_back(mesh.cell_vertex(cell, end).idx());
    return vertices;
}

/// All sets; members of vertex and edge sets are sent as long as the budget lasts.
void add_sets(Contents& contents, const TetMesh& mesh, std::size_t budget, FirstUse& points) {
    static constexpr const char* kinds[] = {"vertex", "edge", "face", "cell"};
    Json& sets = contents.figures["sets"] = Json::array();
    for (std::uint32_t i = 0; i < mesh.n_sets(); ++i) {
        const SetHandle set(i);
        const EntityKind kind = mesh.set_info(set).kind;
        Json entry{{"name", mesh.set_info(set).name},
                   {"kind", kinds[static_cast<std::size_t>(kind)]},
                   {"size", mesh.set_size(set)},
                   {"measure", volmesh::measure(mesh, set)},
                   {"sent", true}};
        if (kind == EntityKind::vertex || kind == EntityKind::edge) {
            Numbers vertices = members(mesh, set);
            entry["sent"] = vertices.size() <= budget;
            if (vertices.size() <= budget) {
                budget -= vertices.size();
                for (std::uint32_t& v : vertices) v = points.number(v);
                contents.blob.add_differences("set " + std::to_string(i), vertices, 1);
            }
        }
        sets.push_back(std::move(entry));
    }
}

}  // namespace

Contents contents_of(const TetMesh& mesh, const quality::Report& report, const PageOptions& options) {
    const std::vector<Quantity> quantities = quantities_of(mesh, report, options.size, options.errors);
    const Grid grid = grid_of(mesh);
    const Selection selection = select_cells(mesh, grid, quantities, listed_cells(report), options.max_cells);
    Contents contents;
    contents.figures = {{"title", options.title},
                        {"vertices", mesh.n_vertices()},
                        {"boundary_faces", mesh.n_boundary_faces()},
                        {"volume", volmesh::volume(mesh)},
                        {"area", volmesh::boundary_area(mesh)},
                        {"report", quality::to_json(report)},
                        {"origin", {grid.origin.x(), grid.origin.y(), grid.origin.z()}},
                        {"step", grid.step},
                        {"extent", grid.extent},
                        {"quantities", quantities_json(quantities)},
                        {"selection", selection_json(selection)}};
    FirstUse points(mesh.n_vertices());
    add_cells(contents, mesh, selection, quantities, points);
    add_sets(contents, mesh, options.max_cells, points);
    Numbers coordinates;
    for (const std::uint32_t v : points.order())
        for (const std::int32_t x : grid.points[v]) coordinates.push_back(static_cast<std::uint32_t>(x));
    contents.blob.add_differences("points", coordinates, 3);
    contents.figures["arrays"] = contents.blob.contents();
    return contents;
}

}  // namespace maille::html
