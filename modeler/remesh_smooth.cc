#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "modeler/remesh_changes.hh"
#include "modeler/remesh_check.hh"
#include "modeler/remesh_features.hh"
#include "modeler/remesh_passes.hh"

namespace maille::modeler::remeshing {

namespace {

constexpr double smoothed = 0.6;  // triangles of this quality, an angle of 37 degrees, are left alone
constexpr double least_gain = 0.005;

/// The mean of the places where v would make each of its triangles isosceles and as high as an equilateral
/// one.
Vec3 mean_of_ideal_apexes(const Net& net, Index v) {
    Vec3 sum = Vec3::Zero();
    const auto around = net.triangles_at(v);
    for (const Index t : around) {
        std::array<Vec3, 2> base;
        std::size_t n = 0;
        for (const Index w : net.triangle(t).vertices)
            if (w != v) base[n++] = net.point(w);
        const Vec3 along = base[1] - base[0];
        const Vec3 middle = (base[0] + base[1]) / 2;
        const Vec3 up =
            (net.point(v) - middle) - along * (along.dot(net.point(v) - middle) / along.squaredNorm());
        sum += middle + up.normalized() * along.norm() * std::sqrt(0.75);
    }
    return sum / static_cast<double>(around.size());
}

/// The worst quality of the triangles at v if that were there.
double worst_quality_at(const Net& net, Index v, const Vec3& to) {
    double worst = 1;
    for (const Index t : net.triangles_at(v)) {
        Corners corners = net.corners(t);
        for (std::size_t k = 0; k < 3; ++k)
            if (net.triangle(t).vertices[k] == v) corners[k] = to;
        worst = std::min(worst, quality(corners));
    }
    return worst;
}

bool try_smoothing(Session& session, Index v) {
    const Net& net = session.net;
    const VertexKind kind = net.kind(v);
    if (kind != VertexKind::face && kind != VertexKind::curve) return false;
    const double before = worst_quality(net, net.triangles_at(v));
    if (before > smoothed) return false;

    const auto surfaces = net.surfaces(net.triangles_at(v));
    const auto ends = neighbours_alike(net, v);
    std::optional<Vec3> best;
    double best_quality = before + least_gain;
    for (const Vec3& aim : {middle(net, ends), mean_of_ideal_apexes(net, v)})
        for (const double step : {1.0, 0.5, 0.25}) {
            const Vec3 wanted = net.point(v) + step * (aim - net.point(v));
            // The projection is the dearest part, and changes the shapes little.
            if (worst_quality_at(net, v, wanted) <= best_quality) continue;
            const auto target = nearest(session, surfaces, kind, wanted, net.size(v));
            if (!target) continue;
            const double after = worst_quality_at(net, v, *target);
            if (after <= best_quality) continue;
            best_quality = after;
            best = target;
        }
    return best && try_change(session, move(net, v, *best), before);
}

}  // namespace

std::size_t smooth_vertices(Session& session) {
    const std::uint64_t since = std::exchange(session.smoothed, session.net.now());
    std::size_t done = 0;
    for (Index v = 0; v < session.net.n_vertices(); ++v)
        if (session.net.touched(v) >= since && !session.net.triangles_at(v).empty() &&
            try_smoothing(session, v))
            ++done;
    session.report.smoothings += done;
    return done;
}

}  // namespace maille::modeler::remeshing
