#include "modeler/build_primitives.hh"

#include <algorithm>
#include <iterator>

#include <fmt/core.h>

#include "modeler/arrange_self_intersection.hh"
#include "modeler/build_copies.hh"
#include "modeler/build_size.hh"
#include "modeler/build_worth.hh"
#include "modeler/closed_surface.hh"
#include "modeler/parallel.hh"
#include "modeler/shape_turned.hh"
#include "modeler/tessellate.hh"
#include "modeler/tetrahedralize.hh"
#include "volmesh/error.hh"

namespace maille::modeler {
namespace {

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

/// By primitive: the edge length away from the model where the primitive is far larger than that, as are
/// cylinders that make edges of a plate round, and else its size. Cells of such primitives would be of no
/// use.
std::vector<double> sizes_beyond(const Model& model, const std::vector<double>& sizes) {
    constexpr double far_larger = 3, parts = 60;
    const Eigen::AlignedBox3d box = bounding_box(model);
    std::vector<double> result = sizes;
    for (std::size_t i = 0; i < sizes.size() && !box.isEmpty(); ++i) {
        const double extent = model.primitives[i].shape->bounding_box().diagonal().norm();
        if (extent > far_larger * box.diagonal().norm()) result[i] = std::max(sizes[i], extent / parts);
    }
    return result;
}

/// The number of each primitive's first surface.
std::vector<std::uint32_t> first_surfaces(const Model& model) {
    std::vector<std::uint32_t> first(model.primitives.size());
    const std::vector<ModelSurface> numbered = surfaces(model);
    for (std::size_t s = numbered.size(); s-- > 0;)
        first[numbered[s].primitive] = static_cast<std::uint32_t>(s);
    return first;
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

bool crosses_itself(const ClosedSurface& surface) {
    FacetComplex complex{surface.points, {}};
    for (const auto& triangle : surface.triangles) complex.facets.push_back({triangle, 0, outside, 0});
    return find_self_intersection(complex).has_value();
}

}  // namespace

PrimitiveMesher::PrimitiveMesher(const Model& model, const BuildOptions& options)
    : model_(model),
      options_(options),
      sizes_(sizes_of_primitives(model, options)),
      sizes_beyond_(sizes_beyond(model, sizes_)),
      shared_(find_shared_surfaces(model.primitives, sizes_beyond_, options.chord_tolerance)),
      first_(first_surfaces(model)),
      is_meshed_(model.primitives.size()) {
    mark_owners(model.tree, is_meshed_);
    const std::vector<std::uint8_t> worth = worth_meshing(model, sizes_);
    for (std::size_t i = 0; i < worth.size(); ++i) is_meshed_[i] &= worth[i] && !is_far_larger(i);
}

Operand PrimitiveMesher::operand(std::size_t i, std::span<const FacePoint> points, bool with_cells,
                                 std::vector<std::string>& warnings) const {
    const Primitive& primitive = model_.primitives[i];
    const auto within = is_far_larger(i) ? bounding_box(model_) : Eigen::AlignedBox3d();
    volmesh::TriMesh surface = tessellate(primitive, {.size = sizes_[i],
                                                      .within = within,
                                                      .size_beyond = sizes_beyond_[i],
                                                      .chord_tolerance = options_.chord_tolerance,
                                                      .is_draft = !with_cells,
                                                      .shared = shared_[i]});
    insert_points(surface, *primitive.shape, points);
    Operand operand{primitive.name, sizes_[i], closed_surface(surface, first_[i]), {}};
    if (const auto* polyhedron = dynamic_cast<const Polyhedron*>(primitive.shape.get()))
        operand.surface.crosses_itself = crosses_itself(closed_surface(*polyhedron));
    else if (dynamic_cast<const Turned*>(primitive.shape.get()) != nullptr)
        operand.surface.crosses_itself = crosses_itself(operand.surface);  // it may touch itself on the axis
    if (!with_cells || !options_.keep_cells || operand.surface.crosses_itself) return operand;
    try {
        operand.mesh = tetrahedralize(surface, sizes_[i],
                                      {.time_limit = options_.time_limit, .name = primitive.name}, &warnings);
    } catch (const InputError& error) {
        // It can still be meshed together with the others.
        warnings.push_back(error.what());
    }
    return operand;
}

std::vector<Operand> PrimitiveMesher::mesh(BuildReport& report) const {
    const std::size_t n = model_.primitives.size();
    std::vector<std::size_t> original = first_alike(model_.primitives, sizes_, shared_);
    for (std::size_t i = 0; i < n; ++i)
        if (is_far_larger(i)) original[i] = i;  // each is fine where the model is
    std::vector<std::uint8_t> with_cells = is_meshed_;
    for (std::size_t i = 0; i < n; ++i) with_cells[original[i]] |= is_meshed_[i];
    std::vector<Operand> operands(n);
    std::vector<std::vector<std::string>> warnings_of(n);
    parallel_for(n, options_.threads, [&](std::size_t i) {
        if (original[i] == i) operands[i] = operand(i, {}, with_cells[i], warnings_of[i]);
    });
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t j = original[i];
        if (j == i) continue;
        operands[i] =
            moved_operand(operands[j], model_.primitives[j], model_.primitives[i], first_[j], first_[i]);
        if (!with_cells[i]) operands[i].mesh = {};
        ++report.moved_primitives;
    }
    for (auto& list : warnings_of) std::ranges::move(list, std::back_inserter(report.warnings));
    return operands;
}

bool PrimitiveMesher::mesh_again(std::vector<Operand>& operands, std::span<const std::size_t> which,
                                 std::span<const std::vector<FacePoint>> points,
                                 std::vector<std::string>& warnings) const {
    std::vector<std::vector<std::string>> warnings_of(which.size());
    std::vector<std::uint8_t> is_fit(which.size());
    parallel_for(which.size(), options_.threads, [&](std::size_t k) {
        const std::size_t i = which[k];
        operands[i] = operand(i, points[i], is_meshed_[i], warnings_of[k]);
        is_fit[k] = !crosses_itself(operands[i].surface);
    });
    for (auto& list : warnings_of) std::ranges::move(list, std::back_inserter(warnings));
    return std::ranges::count(is_fit, 0) == 0;
}

}  // namespace maille::modeler
