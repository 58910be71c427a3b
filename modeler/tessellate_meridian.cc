#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "modeler/meridian.hh"
#include "modeler/tessellate_rows.hh"

namespace maille::modeler {
namespace {

constexpr double pi = std::numbers::pi;

/// Cuts a surface of revolution into rows about its axis.
class RowSizes {
  public:
    RowSizes(const Meridian& meridian, const Eigen::Affine3d& frame, const Sizing& sizing)
        : meridian_(meridian), frame_(frame), sizing_(sizing) {
        const Eigen::Matrix3d& linear = frame.linear();
        const double across = std::sqrt(linear.col(0).cross(linear.col(1)).norm());
        semi_ = meridian.semi.cwiseProduct(Eigen::Vector2d(across, linear.col(2).norm()));
    }

    /// Edges that a row should have: not more than twice as long as the meridian's curvature asks for.
    double edges(double angle) const {
        const Circumference row(frame_, sizing_, meridian_.at(angle).x());
        return std::max(row.edges(), row.length() / (2 * along(angle)));
    }

    /// Angles of rows, from the lower to the upper one.
    std::vector<double> angles(double low, double high) const {
        constexpr int samples = 256;
        std::vector<double> wanted(samples);
        for (int i = 0; i < samples; ++i) {
            const double angle = low + (high - low) * (i + 0.5) / samples;
            const Circumference row(frame_, sizing_, meridian_.at(angle).x());
            wanted[i] =
                std::min(along(angle), row.length() / row.edges()) * std::numbers::sqrt3 / 2 / speed(angle);
        }
        std::vector<double> places = graded_places(wanted, high - low);
        for (double& place : places) place = place < 1 ? low + (high - low) * place : high;
        return places;
    }

  private:
    /// Length along the meridian for each unit of the angle.
    double speed(double angle) const {
        return std::hypot(semi_.x() * std::sin(angle), semi_.y() * std::cos(angle));
    }
    double along(double angle) const {
        return sizing_.for_curvature(semi_.prod() / std::pow(speed(angle), 3));
    }

    const Meridian& meridian_;
    const Eigen::Affine3d& frame_;
    const Sizing& sizing_;
    Eigen::Vector2d semi_;  ///< of the meridian, in space
};

class Seeder {
  public:
    Seeder(const Shape& shape, const Meridian& meridian, const Sizing& sizing,
           const Circumference& directions, const SharedRound& shared)
        : shape_(shape),
          meridian_(meridian),
          frame_(shared.reference.map()),
          rows_(meridian_, frame_, sizing),
          directions_(directions),
          rims_(shared.rims) {}

    SurfaceSeed seed() {
        std::vector<RoundRim> stations = rims_;
        if (meridian_.is_torus()) {
            stations.push_back({rims_.front().angle + 2 * pi, rims_.front().count});
        } else {
            stations.insert(stations.begin(), {-pi / 2, 1});
            stations.push_back({pi / 2, 1});
        }
        const Row first = add_row(stations.front().angle, stations.front().count, 0);
        Row previous = first;
        for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
            const std::vector<double> angles = rows_.angles(stations[i].angle, stations[i + 1].angle);
            for (std::size_t k = 1; k + 1 < angles.size(); ++k) {
                const int wanted = std::max(6, static_cast<int>(std::lround(rows_.edges(angles[k]))));
                const auto [count, offset] =
                    row_between(stations[i].count, stations[i + 1].count, k, angles.size() - 1, wanted);
                add_band(previous, add_row(angles[k], count, offset));
            }
            const bool is_closing = meridian_.is_torus() && i + 2 == stations.size();
            add_band(previous, is_closing ? first : add_row(stations[i + 1].angle, stations[i + 1].count, 0));
        }
        return std::move(seed_);
    }

  private:
    Row add_row(double angle, int count, int offset) {
        const Row row{
            .first = static_cast<std::uint32_t>(seed_.points.size()), .count = count, .offset = offset};
        const Eigen::Vector2d p = meridian_.at(angle);
        for (int i = 0; i < count; ++i) {
            const Eigen::Vector2d xy =
                count == 1 ? Eigen::Vector2d(0, 0)
                           : Eigen::Vector2d(p.x() * directions_.direction(2 * i + offset, 2 * count));
            seed_.add_point(shape_.project(0, frame_ * Point(xy.x(), xy.y(), p.y())));
        }
        return row;
    }

    void add_band(Row& previous, const Row& next) {
        stitch(seed_, previous, next, 0, is_mirror(frame_));
        previous = next;
    }

    const Shape& shape_;
    Meridian meridian_;
    Eigen::Affine3d frame_;
    RowSizes rows_;
    const Circumference& directions_;
    const std::vector<RoundRim>& rims_;
    SurfaceSeed seed_;
};

}  // namespace

int rim_count(const Shape& shape, const Eigen::Affine3d& frame, const Sizing& sizing, double angle) {
    const Meridian meridian = meridian_in(frame, shape).value();
    return 4 * doubling_count(RowSizes(meridian, frame, sizing).edges(angle) / 4, 2);
}

SurfaceSeed seed_shared_surface(const Shape& shape, const Sizing& sizing, const Sizing& sizing_of_reference,
                                const SharedRound& shared) {
    const Circumference directions(shared.reference.map(), sizing_of_reference, 1);
    return Seeder(shape, meridian_in(shared.reference.map(), shape).value(), sizing, directions, shared)
        .seed();
}

}  // namespace maille::modeler
