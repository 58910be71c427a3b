#include "modeler/merge_operand.hh"

#include <algorithm>
#include <array>
#include <exception>
#include <new>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "modeler/merge_glue.hh"
#include "modeler/merge_zone.hh"
#include "modeler/tetrahedralize.hh"
#include "volmesh/error.hh"

namespace maille::modeler {
namespace {

/// One way to make the mesh.
struct Way {
    bool keep_cells;
    bool remesh_surface;
    const char* words;
};

constexpr std::array<Way, 2> first_ways{
    {{true, true, "keeping cells"}, {false, true, "meshing everything anew"}}};
constexpr Way last_way{false, false, "meshing everything anew on the surfaces as they are"};

class Merger {
  public:
    Merger(std::span<Operand> operands, const CsgTree& tree, const RemeshGeometry& geometry,
           std::uint32_t n_surfaces, const MergeSettings& settings, std::vector<std::string>& warnings)
        : operands_(operands),
          tree_(tree),
          geometry_(with_shell(geometry, n_surfaces)),
          shell_surface_(n_surfaces),
          may_take_mesh_(settings.may_take_mesh),
          options_{.time_limit = settings.time_limit, .name = names(operands)},
          warnings_(warnings) {
        for (const Operand& operand : operands) sizes_.push_back(operand.size);
    }

    Merged merge(const FacetComplex& interface, const Way& way) const {
        const InterfaceTable table(interface);
        const std::vector<KeptPart> kept = way.keep_cells
                                               ? choose_kept_cells(operands_, tree_, interface, table)
                                               : std::vector<KeptPart>(operands_.size());
        FacetComplex zone = zone_complex(operands_, kept, interface, table, shell_surface_);
        if (way.remesh_surface) remesh_surface(zone);
        const FacetComplex bounds = bounds_of_new_cells(zone);
        const ComplexMesh new_cells = tetrahedralize(bounds, sizes_, options_, &warnings_);
        return glue(operands_, kept, zone, bounds, new_cells, shell_surface_, may_take_mesh_);
    }

    /// Of the operands, for messages.
    const std::string& names() const { return options_.name; }

  private:
    /// The kept cells' other faces lie on no surface of the model, and don't move.
    static RemeshGeometry with_shell(const RemeshGeometry& geometry, std::uint32_t shell) {
        return {.project = [=](std::span<const std::uint32_t> surfaces,
                               const Eigen::Vector3d& p) -> std::optional<Eigen::Vector3d> {
                    if (std::ranges::find(surfaces, shell) != surfaces.end()) return std::nullopt;
                    return geometry.project(surfaces, p);
                },
                .touch = [=](std::uint32_t a, std::uint32_t b,
                             const Eigen::Vector3d& p) -> std::optional<Eigen::Vector3d> {
                    if (a == shell || b == shell) return std::nullopt;
                    return geometry.touch(a, b, p);
                },
                .normal = [=](std::uint32_t surface, const Eigen::Vector3d& p) -> Eigen::Vector3d {
                    return surface == shell ? Eigen::Vector3d::UnitZ().eval() : geometry.normal(surface, p);
                },
                .planar = [=](std::uint32_t surface) { return surface != shell && geometry.planar(surface); },
                .size = geometry.size};
    }

    static std::string names(std::span<const Operand> operands) {
        constexpr std::size_t most = 4;
        std::string text;
        for (std::size_t i = 0; i < std::min(operands.size(), most); ++i)
            text += (i > 0 ? ", " : "") + operands[i].name;
        return operands.size() > most ? fmt::format("{} and {} others", text, operands.size() - most) : text;
    }

    void remesh_surface(FacetComplex& zone) const {
        if (std::ranges::all_of(zone.facets, &Facet::frozen)) return;
        if (remesh(zone, geometry_).rolled_back)
            warnings_.push_back("remeshing the surfaces was undone, because they came to cross each other");
    }

    std::span<Operand> operands_;
    const CsgTree& tree_;
    RemeshGeometry geometry_;
    std::uint32_t shell_surface_;
    bool may_take_mesh_;
    TetrahedralizeOptions options_;
    std::vector<double> sizes_;
    std::vector<std::string>& warnings_;
};

FacetComplex arranged_surfaces(std::span<const Operand> operands, const CsgTree& tree) {
    std::vector<ClosedSurface> surfaces;
    for (const Operand& operand : operands) surfaces.push_back(operand.surface);
    try {
        return arrange(surfaces, tree).complex;
    } catch (const ArrangeError& error) {
        std::vector<std::string> names;
        for (const std::uint32_t i : error.primitives()) names.push_back(operands[i].name);
        const Eigen::Vector3d& p = error.place();
        throw InputError(fmt::format("the surfaces of {} near ({:.9g}, {:.9g}, {:.9g}) {}",
                                     fmt::join(names, " and "), p.x(), p.y(), p.z(), error.problem()));
    }
}

}  // namespace

std::vector<Origin> Kept::origins() const {
    std::vector<Origin> all;
    all.reserve(size());
    for (std::uint32_t i = 0; i < n_base; ++i) all.push_back({base, i});
    for (std::uint32_t i = 0; i < moved.size(); ++i)
        if (moved[i] != volmesh::TetMesh::none) all[moved[i]].index = n_base + i;
    all.insert(all.end(), further.begin(), further.end());
    return all;
}

Merged merge_operands(std::span<Operand> operands, const CsgTree& tree, const RemeshGeometry& geometry,
                      std::uint32_t n_surfaces, const MergeSettings& settings,
                      std::vector<std::string>& warnings) {
    const FacetComplex interface = arranged_surfaces(operands, tree);
    if (interface.facets.empty()) throw InputError("the model is empty: its operations leave no volume");
    const Merger merger(operands, tree, geometry, n_surfaces, settings, warnings);
    for (const Way& way : first_ways) {
        if (way.keep_cells && !settings.keep_cells) continue;
        try {
            return merger.merge(interface, way);
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const std::exception& error) {
            warnings.push_back(fmt::format("{} failed: {}", way.words, error.what()));
        }
    }
    try {
        return merger.merge(interface, last_way);
    } catch (const std::logic_error& error) {
        throw InputError(fmt::format("{} cannot be meshed: {}", merger.names(), error.what()));
    }
}

}  // namespace maille::modeler
