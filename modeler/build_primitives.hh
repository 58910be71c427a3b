#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "modeler/build.hh"
#include "modeler/merge_operand.hh"
#include "modeler/shared_surface.hh"
#include "modeler/tessellate_insert.hh"

namespace maille::modeler {

/// Meshes the primitives of a model, each by itself. The model must outlive it.
class PrimitiveMesher {
  public:
    /// Throws InputError where the size is negative.
    PrimitiveMesher(const Model& model, const BuildOptions& options);

    /// All of them; those that differ in place only are meshed once.
    std::vector<Operand> mesh(BuildReport& report) const;
    /// Some again, with points, by primitive, as vertices of their surfaces. Returns whether all these are
    /// fit to be merged: thin solids can come to cross themselves.
    bool mesh_again(std::vector<Operand>& operands, std::span<const std::size_t> which,
                    std::span<const std::vector<FacePoint>> points, std::vector<std::string>& warnings) const;

  private:
    bool is_far_larger(std::size_t i) const { return sizes_beyond_[i] > sizes_[i]; }
    Operand operand(std::size_t i, std::span<const FacePoint> points, bool with_cells,
                    std::vector<std::string>& warnings) const;

    const Model& model_;
    const BuildOptions& options_;
    std::vector<double> sizes_;
    std::vector<double>
        sizes_beyond_;  ///< of the far larger ones, of which only surfaces near the model are fine
    std::vector<std::shared_ptr<const SharedSurface>> shared_;
    std::vector<std::uint32_t> first_;
    std::vector<std::uint8_t> is_meshed_;
};

}  // namespace maille::modeler
