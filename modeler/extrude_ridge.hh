#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "modeler/primitive.hh"
#include "modeler/shapes.hh"

namespace maille::modeler {

/// The line in which a solid ends whose shape narrows in one direction to nothing. The sides that meet there
/// come with different corners on it; they get all of them, so that they have their edges in common.
class Ridge {
  public:
    /// Points on the ridge, those from `first` on, lie along that axis. Makes equal what differs by rounding.
    Ridge(std::vector<Point>& points, std::uint32_t first, Eigen::Index axis);

    /// A triangle from its foot to the corners on the ridge.
    void add(std::uint32_t foot, std::uint32_t from, std::uint32_t to, const std::string& name);

    /// All of them, without what lies on another one and looks the other way: a fold of no thickness.
    std::vector<PolyhedronFace> faces() const;

  private:
    struct Fan {
        std::uint32_t foot;
        std::vector<std::uint32_t> corners;  ///< on the ridge, in order
        std::string name;
    };

    std::vector<std::pair<double, std::uint32_t>> places_;  ///< distinct, rising, and the first corner there
    std::vector<double> place_of_;                          ///< of each corner from first_ on
    std::uint32_t first_;
    std::vector<Fan> fans_;
    std::set<std::array<std::uint32_t, 3>> parts_;  ///< of fans: the foot, and an edge on the ridge
};

}  // namespace maille::modeler
