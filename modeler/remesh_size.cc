#include <algorithm>
#include <array>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "modeler/remesh_gaps.hh"
#include "modeler/remesh_passes.hh"

namespace maille::modeler::remeshing {

namespace {

constexpr double growth = 0.4;  // of the size, over a distance of one

double wanted_size(const Session& session, Index v) {
    double size = std::numeric_limits<double>::infinity();
    for (const Index t : session.net.triangles_at(v)) {
        const Patch& patch = session.net.patch(t);
        size = std::min(size, session.geometry.size(session.net.point(v), patch.front, patch.back));
    }
    return size;
}

/// The mean length of the frozen edges at v; 0 where there is none.
double frozen_size(const Net& net, Index v) {
    double sum = 0;
    int count = 0;
    for (const Index t : net.triangles_at(v)) {
        if (!net.patch(t).frozen) continue;
        for (const Index w : net.triangle(t).vertices)
            if (w != v) {
                sum += net.length(v, w);
                ++count;
            }
    }
    return count == 0 ? 0 : sum / count;
}

/// Lets no size be more than the smallest one beside it and the growth over the distance (Dijkstra).
void limit_growth(Net& net) {
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (Index v = 0; v < net.n_vertices(); ++v)
        if (!net.triangles_at(v).empty()) queue.push({net.size(v), v});
    while (!queue.empty()) {
        const auto [size, v] = queue.top();
        queue.pop();
        if (size > net.size(v)) continue;
        for (const Index w : net.neighbours(v)) {
            const double most = size + growth * net.length(v, w);
            if (most >= net.size(w)) continue;
            net.set_size(w, most);
            queue.push({most, w});
        }
    }
}

/// About how many triangles that are not frozen there will be, with these sizes at the vertices.
double expected_triangles(const Net& net, const std::vector<double>& sizes) {
    double count = 0;
    for (Index t = 0; t < net.n_triangles(); ++t) {
        if (!net.is_alive(t) || net.patch(t).frozen) continue;
        const auto [a, b, c] = net.corners(t);
        double size = 0;
        for (const Index v : net.triangle(t).vertices) size += sizes[v] / 3;
        count += (b - a).cross(c - a).norm() / 2 / (size * size * std::sqrt(3) / 4);
    }
    return count;
}

/// Makes the smallest sizes larger where there would be too many triangles.
void limit_count(Session& session) {
    const Net& net = session.net;
    std::vector<double>& sizes = session.gap_sizes;
    std::size_t n_now = 0;
    for (Index t = 0; t < net.n_triangles(); ++t) n_now += net.is_alive(t) && !net.patch(t).frozen;
    const double most = session.options.most_growth *
                        (static_cast<double>(n_now) + expected_triangles(net, session.wanted_sizes));
    for (;;) {
        const double excess = expected_triangles(net, sizes) / most;
        if (excess <= 1 || session.smallest_gap >= 1) return;
        session.smallest_gap = std::min(1.0, session.smallest_gap * std::max(1.1, std::sqrt(excess)));
        for (Index v = 0; v < net.n_vertices(); ++v)
            if (frozen_size(net, v) == 0)
                sizes[v] = std::max(sizes[v], session.smallest_gap * session.wanted_sizes[v]);
    }
}

}  // namespace

void set_sizes(Session& session) {
    Net& net = session.net;
    const Surroundings surroundings(net);
    std::vector<double>& sizes = session.gap_sizes;
    std::vector<double>& wanted = session.wanted_sizes;
    sizes.resize(net.n_vertices(), 0);
    wanted.resize(net.n_vertices(), 0);
    const auto find_size = [&](GapFinder& gaps, Index v) {
        if (net.triangles_at(v).empty()) return;
        if (const double frozen = frozen_size(net, v); frozen > 0) {
            sizes[v] = wanted[v] = frozen;
            return;
        }
        // What was found before holds where nothing has changed as far as was looked for it.
        if (sizes[v] > 0 && !gaps.has_changed(v, sizes[v], session.sized)) return;
        wanted[v] = wanted_size(session, v);
        sizes[v] = gaps.size_at(v, wanted[v], session.smallest_gap * wanted[v]);
    };
    tbb::enumerable_thread_specific<GapFinder> finders([&] { return GapFinder(surroundings); });
    tbb::parallel_for(tbb::blocked_range<Index>(0, net.n_vertices(), 256), [&](const auto& range) {
        GapFinder& gaps = finders.local();
        for (Index v = range.begin(); v < range.end(); ++v) find_size(gaps, v);
    });
    // Later there are more triangles because of it.
    if (session.sized == 0) limit_count(session);
    for (Index v = 0; v < net.n_vertices(); ++v)
        if (!net.triangles_at(v).empty()) net.set_size(v, sizes[v]);
    limit_growth(net);
    session.sized = net.now();
}

}  // namespace maille::modeler::remeshing
