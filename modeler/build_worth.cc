#include "modeler/build_worth.hh"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace maille::modeler {
namespace {

constexpr double few_cells = 100'000;  // are made in half a second
constexpr double least_kept = 0.1;     // of the cells
constexpr double margin = 2;           // sizes: about the layers of cells that go beside an interface
constexpr std::uint32_t n_places = 4096;

/// The number of a primitive's cells if it filled its box.
double most_cells(const Eigen::AlignedBox3d& box, double size) {
    return 6 * std::numbers::sqrt2 * box.volume() / (size * size * size);
}

/// Evenly spread over the box. (Roberts, The unreasonable effectiveness of quasirandom sequences, 2018.)
Point place_in(const Eigen::AlignedBox3d& box, std::uint32_t n) {
    constexpr double g = 1.22074408460575947536;  // g^4 = g + 1
    Point part;
    double whole;
    for (int k = 0; k < 3; ++k) part[k] = std::modf(0.5 + n / std::pow(g, k + 1), &whole);
    return box.min() + part.cwiseProduct(box.sizes());
}

class KeptShare {
  public:
    explicit KeptShare(const Model& model) : model_(model) {
        for (const Primitive& primitive : model.primitives) boxes_.push_back(primitive.shape->bounding_box());
    }

    double of(std::uint32_t primitive, double size) const {
        std::uint32_t n_inside = 0, n_kept = 0;
        for (std::uint32_t n = 0; n < n_places; ++n) {
            const Point p = place_in(boxes_[primitive], n);
            if (!contains(primitive, p)) continue;
            ++n_inside;
            n_kept += is_kept(primitive, p, margin * size);
        }
        return n_inside == 0 ? 1 : static_cast<double>(n_kept) / n_inside;
    }

    const Eigen::AlignedBox3d& box(std::uint32_t primitive) const { return boxes_[primitive]; }

  private:
    bool contains(std::uint32_t i, const Point& p) const {
        return boxes_[i].contains(p) && model_.primitives[i].shape->contains(p);
    }
    bool owns(std::uint32_t primitive, const Point& p) const {
        return owner(model_.tree, [&](std::uint32_t i) { return contains(i, p); }) == primitive;
    }
    bool is_kept(std::uint32_t primitive, const Point& p, double distance) const {
        if (!owns(primitive, p)) return false;
        for (int k = 0; k < 3; ++k)
            for (const double step : {-distance, distance}) {
                const Point beside = p + step * Point::Unit(k);
                if (contains(primitive, beside) && !owns(primitive, beside)) return false;
            }
        return true;
    }

    const Model& model_;
    std::vector<Eigen::AlignedBox3d> boxes_;
};

}  // namespace

std::vector<std::uint8_t> worth_meshing(const Model& model, std::span<const double> sizes) {
    const KeptShare share(model);
    std::vector<std::uint8_t> worth(model.primitives.size(), 1);
    for (std::uint32_t i = 0; i < worth.size(); ++i)
        if (most_cells(share.box(i), sizes[i]) > few_cells) worth[i] = share.of(i, sizes[i]) >= least_kept;
    return worth;
}

}  // namespace maille::modeler
