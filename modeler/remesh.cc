#include "modeler/remesh.hh"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "modeler/arrange_self_intersection.hh"
#include "modeler/remesh_check.hh"
#include "modeler/remesh_features.hh"
#include "modeler/remesh_passes.hh"

namespace maille::modeler {

namespace {

using namespace remeshing;

constexpr int smoothing_sweeps = 3;
constexpr int rounds_with_new_sizes = 3;
constexpr double tolerated_at_first = 0.4;
constexpr double stalled = 0.7;  // of the changes of the round before: more rounds gain little

double smallest_angle(const Net& net) {
    double worst = 1;
    for (Index t = 0; t < net.n_triangles(); ++t)
        if (net.is_alive(t) && !net.patch(t).frozen) worst = std::min(worst, quality(net.corners(t)));
    return std::asin(std::min(worst, std::sqrt(0.75))) * 180 / std::numbers::pi;
}

/// One round of all passes; the number of changes.
std::size_t work(Session& session) {
    session.net.pack_tree();
    std::size_t changes = collapse_edges(session);
    changes += project_vertices(session);
    changes += flip_edges(session);
    changes += split_edges(session);
    changes += flip_edges(session);
    changes += snap_to_curves(session);
    for (int sweep = 0; sweep < smoothing_sweeps; ++sweep) changes += smooth_vertices(session);
    changes += flip_edges(session);
    return changes;
}

}  // namespace

RemeshReport remesh(FacetComplex& complex, const RemeshGeometry& geometry, const RemeshOptions& options) {
    if (complex.facets.empty()) return {};
    Session session{make_net(complex, geometry), geometry, options};
    session.good = std::sin(options.min_angle * std::numbers::pi / 180);
    session.report.smallest_angle_before = smallest_angle(session.net);

    // Not before the slivers are gone can gaps be told from them.
    session.net.pack_tree();
    collapse_edges(session);
    bool is_strict = false;
    std::size_t before = std::numeric_limits<std::size_t>::max();
    for (int round = 0; round < options.rounds; ++round) {
        is_strict = is_strict || round >= options.rounds / 2;
        session.tolerated = is_strict ? session.good : tolerated_at_first * session.good;
        if (round < rounds_with_new_sizes) set_sizes(session);
        const std::size_t changes = work(session);
        if (changes == 0) break;
        const bool is_stalled = static_cast<double>(changes) > stalled * static_cast<double>(before);
        if (is_stalled && is_strict) break;
        is_strict = is_strict || (is_stalled && round + 1 >= rounds_with_new_sizes);
        before = changes;
    }

    if (clear_ways(session) > 0) work(session);

    session.report.short_of_surface = count_short_of_surface(session);
    session.report.smallest_angle_after = smallest_angle(session.net);
    FacetComplex result = make_complex(session.net);
    // Every change was checked where it was made; this is for what no local check can see.
    session.report.rolled_back = find_self_intersection(result) && !find_self_intersection(complex);
    if (!session.report.rolled_back) complex = std::move(result);
    return session.report;
}

}  // namespace maille::modeler
