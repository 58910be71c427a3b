// Netgen's extrusion: a profile along a path.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "modeler/geo_body.hh"
#include "modeler/shapes.hh"
#include "volmesh/error.hh"

namespace maille::modeler {
namespace {

/// A place on the path: where the profile's axes point, and the plane that it is cut in.
struct Station {
    Point origin, x, z, tangent, cut;
};

Station station_at(const Point& origin, const Point& tangent, const Point& z) {
    const Point up = (z - z.dot(tangent) * tangent);
    if (!(up.norm() > 1e-9 * z.norm())) throw InputError("its path runs along the direction z");
    return {origin, tangent.cross(up.normalized()), up.normalized(), tangent, tangent};
}

std::vector<Station> stations_of(const GeoCurve<3>& path, const Point& z, bool closed) {
    std::vector<Station> stations;
    for (const GeoSegment<3>& segment : path) {
        const int n =
            segment.is_straight ? 1 : std::max(2, static_cast<int>(std::ceil(segment.turn() / finest_turn)));
        for (int k = 0; k < n; ++k) {
            const double t = static_cast<double>(k) / n;
            stations.push_back(station_at(segment.at(t), segment.tangent(t), z));
        }
    }
    const GeoSegment<3>& last = path.back();
    stations.push_back(station_at(last.c, last.tangent(1), z));
    // Where the path has a bend, both of its sides end in the plane between them.
    std::size_t first = 0;
    for (std::size_t i = 0; i < path.size(); ++i) {
        const Point before = path[(i + path.size() - 1) % path.size()].tangent(1), after = path[i].tangent(0);
        if ((i > 0 || closed) && (before - after).norm() > 1e-9) {
            if ((before + after).norm() < 1e-3) throw InputError("its path turns back on itself");
            stations[first].cut = (before + after).normalized();
        }
        const int n =
            path[i].is_straight ? 1 : std::max(2, static_cast<int>(std::ceil(path[i].turn() / finest_turn)));
        first += static_cast<std::size_t>(n);
    }
    if (closed) stations.pop_back();
    return stations;
}

Point placed(const Station& at, const Point2& q) {
    const Point p = at.origin + q.x() * at.x + q.y() * at.z;
    return p - at.cut.dot(p - at.origin) / at.cut.dot(at.tangent) * at.tangent;
}

}  // namespace

GeoBody geo_extrusion(const GeoCurve<3>& path, const GeoCurve<2>& profile, const Point& z) {
    std::vector<ProfileEdge> edges = edges_of(profile, false);
    if (edges.front().from != edges.back().to) throw InputError("its profile has to be closed");
    if (area_within(edges) < 0) turn_back(edges);
    const bool closed = path.front().a == path.back().c;
    const std::vector<Station> stations = stations_of(path, z, closed);

    const auto n = static_cast<std::uint32_t>(edges.size());
    const auto n_stations = static_cast<std::uint32_t>(stations.size());
    std::vector<Point> points;
    for (const Station& station : stations)
        for (const ProfileEdge& edge : edges) points.push_back(placed(station, edge.from));
    std::vector<PolyhedronFace> faces;
    for (std::uint32_t i = 0; i + (closed ? 0 : 1) < n_stations; ++i) {
        const std::uint32_t below = i * n, above = (i + 1) % n_stations * n;
        for (std::uint32_t k = 0; k < n; ++k) {
            const std::uint32_t next = (k + 1) % n;
            faces.push_back({{{below + k, above + k, above + next, below + next}}, edges[k].name});
        }
    }
    if (!closed)
        for (const bool end : {false, true}) {
            std::vector<std::uint32_t> cap;
            for (std::uint32_t k = 0; k < n; ++k) cap.push_back((end ? (n_stations - 1) * n : 0) + k);
            if (end) std::ranges::reverse(cap);
            faces.push_back({{std::move(cap)}, end ? "end" : "start"});
        }
    return finite_body(
        [points, faces](const Eigen::Affine3d& map) { return make_polyhedron(points, faces, map); },
        numbered_faces("side", profile.size()));
}

}  // namespace maille::modeler
