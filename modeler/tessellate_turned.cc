#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "modeler/openscad_facets.hh"
#include "modeler/shape_frame.hh"
#include "modeler/tessellate_rows.hh"

namespace maille::modeler {
namespace {

using Loop = std::vector<std::uint32_t>;

/// Where a profile's point goes: a row of points around the axis, or only its first and last place.
struct Station {
    Row row;
    std::uint32_t start = 0, end = 0;  ///< equal on the axis and in a full turn
};

/// An edge of the profile between the stations of its ends.
struct SideStations {
    const ProfileEdge* edge;
    std::uint32_t face = 0;
    std::vector<Station> within{};  ///< from its start to its end
};

double greatest_radius(const Turned& shape) {
    double greatest = 0;
    for (const auto& loop : shape.profile())
        for (const ProfileEdge& edge : loop) greatest = std::max(greatest, edge.from.x());
    return greatest > 0 ? greatest : shape.profile().front().front().radius();
}

class Seeder {
  public:
    Seeder(const Turned& shape, const Sizing& sizing)
        : shape_(shape),
          sizing_(sizing),
          widest_(shape.map(), sizing, greatest_radius(shape)),
          mirrored_(is_mirror(shape.map())) {}

    SurfaceSeed seed() {
        std::vector<Loop> start_loops, end_loops;
        std::uint32_t face = 0;
        for (const auto& loop : shape_.profile()) {
            std::vector<SideStations> sides;
            for (const ProfileEdge& edge : loop)
                sides.push_back({.edge = &edge, .face = edge.on_axis() ? none : face++});
            add_loop(sides, start_loops, end_loops);
        }
        if (!shape_.is_full()) {
            for (const bool end : {false, true})
                fill_planar_face(seed_, shape_.plane(shape_.cap(end)), end ? end_loops : start_loops,
                                 shape_.cap(end), sizing_.size());
        }
        return std::move(seed_);
    }

  private:
    static constexpr std::uint32_t none = ~0U;

    /// Whether two curved sides have nothing but a point of the axis in common: each gets a point of its own
    /// there.
    bool touches_itself(const SideStations& before, const SideStations& after) const {
        return shape_.is_full() && after.edge->from.x() == 0 && is_curved(before) && is_curved(after);
    }

    void add_loop(std::vector<SideStations>& sides, std::vector<Loop>& start_loops,
                  std::vector<Loop>& end_loops) {
        const std::size_t n = sides.size();
        std::vector<Station> corners, arrivals;  // where sides begin and end
        for (std::size_t i = 0; i < n; ++i) {
            const SideStations& before = sides[(i + n - 1) % n];
            corners.push_back(corner(before, sides[i]));
            arrivals.push_back(touches_itself(before, sides[i]) ? corner(before, sides[i]) : corners.back());
        }
        Loop &start = start_loops.emplace_back(), &end = end_loops.emplace_back();
        for (std::size_t i = 0; i < n; ++i) {
            add_stations(sides[i]);
            cover(sides[i], corners[i], arrivals[(i + 1) % n]);
            start.push_back(corners[i].start);
            end.push_back(corners[i].end);
            for (const Station& station : sides[i].within) {
                start.push_back(station.start);
                end.push_back(station.end);
            }
        }
    }

    bool is_planar(const SideStations& side) const {
        return side.face != none && shape_.faces()[side.face].planar;
    }

    bool is_curved(const SideStations& side) const { return side.face != none && !is_planar(side); }

    std::uint32_t add_point(const Point2& q, const Eigen::Vector2d& direction,
                            std::initializer_list<std::uint32_t> planes) {
        Point p = shape_.map() * Point(q.x() * direction.x(), q.x() * direction.y(), q.y());
        for (const std::uint32_t face : planes)
            if (face != none) p = shape_.project(face, p);
        return seed_.add_point(p);
    }

    Eigen::Vector2d direction(double degrees) const { return {cos_degrees(degrees), sin_degrees(degrees)}; }

    /// A row all round, or from the start to the end; `lower` and `upper` are planar faces that it lies on.
    Station add_row(const Point2& q, int all_round, int offset, std::uint32_t lower, std::uint32_t upper) {
        Station station{.row = {.first = static_cast<std::uint32_t>(seed_.points.size()), .count = 1}};
        Row& row = station.row;
        if (q.x() == 0) {
            add_point(q, Eigen::Vector2d::UnitX(), {lower, upper});
            seed_.corners.push_back(row.first);
            station.start = station.end = row.first;
        } else if (shape_.is_full()) {
            row.count = all_round;
            row.offset = offset;
            for (int k = 0; k < row.count; ++k)
                add_point(q, widest_.direction(2 * k + offset, 2 * row.count), {lower, upper});
            station.start = station.end = row.first;
        } else {
            row.count = std::max(2, static_cast<int>(std::lround(all_round * shape_.span() / 360)));
            row.closed = false;
            for (int k = 0; k <= row.count; ++k)
                add_point(q, direction(shape_.span() * k / row.count),
                          {k == 0           ? shape_.cap(false)
                           : k == row.count ? shape_.cap(true)
                                            : none,
                           lower, upper});
            station.start = row.first;
            station.end = row.at(row.count);
        }
        return station;
    }

    Station corner(const SideStations& before, const SideStations& after) {
        const Point2& q = after.edge->from;
        if (shape_.is_full() && q.x() == 0 && !is_curved(before) && !is_curved(after))
            return {.row = {.count = 1}};  // the middle of a disc
        double slant = std::numeric_limits<double>::infinity();
        for (const SideStations* side : {&before, &after})
            if (side->face != none) slant = std::min(slant, slant_of(*side->edge));
        const int count = q.x() > 0 ? rim_count(Circumference(shape_.map(), sizing_, q.x()), slant) : 1;
        const Station station = add_row(q, count, 0, is_planar(before) ? before.face : none,
                                        is_planar(after) ? after.face : none);
        if (!shape_.is_full() && q.x() > 0)
            for (const std::uint32_t v : {station.start, station.end}) seed_.corners.push_back(v);
        return station;
    }

    /// Mean length of the images of an edge round the axis.
    double slant_of(const ProfileEdge& edge) const {
        constexpr int samples = 8;
        const Point2 way = edge.to - edge.from;
        if (edge.centre) return edge.length() * std::cbrt(std::abs(shape_.map().linear().determinant()));
        double sum = 0;
        for (int i = 0; i < samples; ++i) {
            const Eigen::Vector2d u = unit_circle(i, samples) * way.x();
            sum += (shape_.map().linear() * Point(u.x(), u.y(), way.y())).norm() / samples;
        }
        return sum;
    }

    void add_stations(SideStations& side) {
        const bool curved = is_curved(side);
        if (!curved && shape_.is_full()) return;
        constexpr int samples = 256;
        const ProfileEdge& edge = *side.edge;
        std::vector<double> wanted(samples, sizing_.size());
        const double along = edge.centre
                                 ? sizing_.for_curvature(1 / (edge.radius() * slant_of(edge) / edge.length()))
                                 : sizing_.size();
        for (int i = 0; curved && i < samples; ++i) {
            const double radius = edge.at((i + 0.5) / samples).x();
            const Circumference row(shape_.map(), sizing_, radius);
            wanted[i] = std::min(along, row.length() / row.edges()) * std::numbers::sqrt3 / 2;
        }
        const std::vector<double> places = graded_places(wanted, slant_of(edge));
        for (std::size_t k = 1; k + 1 < places.size(); ++k) {
            const Point2 q = edge.at(places[k]);
            if (curved) {
                const double edges = Circumference(shape_.map(), sizing_, q.x()).edges();
                side.within.push_back(add_row(q, std::max(6, static_cast<int>(std::lround(edges))),
                                              static_cast<int>(k % 2), none, none));
            } else {
                side.within.push_back(add_ends(side, q));
            }
        }
    }

    Station add_ends(const SideStations& side, const Point2& q) {
        Station station;
        station.start = add_point(q, direction(0), {shape_.cap(false), side.face});
        station.end =
            q.x() > 0 ? add_point(q, direction(shape_.span()), {shape_.cap(true), side.face}) : station.start;
        return station;
    }

    void cover(const SideStations& side, const Station& from, const Station& to) {
        if (side.face == none) return;
        if (is_curved(side)) {
            const Station* previous = &from;
            for (const Station& station : side.within) {
                stitch(seed_, previous->row, station.row, side.face, mirrored_);
                previous = &station;
            }
            stitch(seed_, previous->row, to.row, side.face, mirrored_);
            return;
        }
        std::vector<Loop> loops;
        if (shape_.is_full()) {
            for (const Station* ring : {&from, &to})
                if (ring->row.edges() > 0) append(loops.emplace_back(), ring->row, false);
        } else {
            Loop& loop = loops.emplace_back();
            append(loop, from.row, false);
            for (const Station& station : side.within) loop.push_back(station.end);
            append(loop, to.row, true);
            for (auto station = side.within.rbegin(); station != side.within.rend(); ++station)
                loop.push_back(station->start);
        }
        fill_planar_face(seed_, shape_.plane(side.face), loops, side.face, sizing_.size());
    }

    static void append(Loop& loop, const Row& row, bool backwards) {
        const int n = row.closed ? row.count : row.count + 1;
        for (int k = 0; k < n; ++k) loop.push_back(row.at(backwards ? n - 1 - k : k));
    }

    const Turned& shape_;
    const Sizing& sizing_;
    Circumference widest_;
    bool mirrored_;
    SurfaceSeed seed_;
};

}  // namespace

SurfaceSeed seed_surface(const Turned& shape, const Sizing& sizing) {
    return Seeder(shape, sizing).seed();
}

}  // namespace maille::modeler
