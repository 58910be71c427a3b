#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "modeler/arrange_box_tree.hh"
#include "modeler/remesh_net.hh"

namespace maille::modeler::remeshing {

/// The triangles and the curves of a net, to be looked up by place. The net must not change meanwhile.
class Surroundings {
  public:
    /// A triangle, with its corners at hand.
    struct Sheet {
        Index number;
        Corners corners;
        std::array<bool, 3> on_curve;  ///< which sides are feature edges; each is told of one triangle
    };

    explicit Surroundings(const Net& net);

    const Net& net() const { return net_; }
    const Sheet& sheet(std::uint32_t i) const { return sheets_[i]; }
    /// The other ends of the feature edges at the vertex.
    const std::vector<Index>& curves_at(Index v) const { return curves_[v]; }

    /// Calls f(i) for each sheet i that may come nearer to v than `reach`, until f says false. Returns
    /// whether it never did.
    template <class F>
    bool visit(Index v, double reach, const F& f) const {
        const Vec3 most = Vec3::Constant(reach);
        return boxes_.visit_box({net_.point(v) - most, net_.point(v) + most}, f);
    }

  private:
    const Net& net_;
    std::vector<std::vector<Index>> curves_;
    std::vector<Sheet> sheets_;
    modeler::detail::BoxTree boxes_;
};

/// Finds how wide the gaps between sheets and the strips between curves are around vertices. For one thread.
class GapFinder {
  public:
    explicit GapFinder(const Surroundings& around);

    /// Whether any triangle changed after that time that the size found at v depends on.
    bool has_changed(Index v, double size, std::uint64_t since) const;

    /// The size that suits the sheets and curves close to v: at most the one wanted. One below `least` counts
    /// as that. Looking further step by step spares looking far where there are gaps, and at thousands of
    /// triangles where they are small.
    double size_at(Index v, double wanted, double least);

  private:
    class MayFace;
    /// An edge of a curve near the vertex that is looked at.
    struct NearEdge {
        double distance;
        Index a, b;
        bool is_reached;  ///< along curves, by a way that is not much longer
    };
    /// Asks for the way to the end of an edge.
    struct Question {
        std::size_t edge;
        Index next;  ///< at the same end, or `none`
    };

    static constexpr double unreached = std::numeric_limits<double>::infinity();

    double gap_to_sheets(Index v, const MayFace& may_face, double reach, double gap) const;
    double gap_to_curves(Index v, double reach, double gap);
    void find_ways(Index v);

    const Surroundings& surroundings_;
    const Net& net_;
    std::vector<std::uint32_t> nearby_;  ///< sheets
    std::vector<NearEdge> edges_;
    std::vector<double> ways_;
    std::vector<Index> reached_;
    std::vector<Question> questions_;
    std::vector<Index> questions_at_;  ///< the last question for each vertex
};

}  // namespace maille::modeler::remeshing
