#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "modeler/close_values.hh"
#include "modeler/openscad_facets.hh"
#include "modeler/shape_frame.hh"
#include "modeler/shape_turned.hh"
#include "volmesh/error.hh"

namespace maille::modeler {
namespace {

template <class Visit>
void for_each_edge(Profile& profile, const Visit& visit) {
    for (auto& loop : profile)
        for (ProfileEdge& edge : loop) visit(edge);
}

/// The least and the greatest distance from the axis, with sign.
std::pair<double, double> reach(Profile& profile) {
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    for_each_edge(profile, [&](const ProfileEdge& edge) {
        const auto extend = [&](double x) {
            least = std::min(least, x);
            greatest = std::max(greatest, x);
        };
        extend(edge.from.x());
        if (!edge.centre) return;
        for (const double side : {-1.0, 1.0}) {
            const Point2 end = *edge.centre + side * edge.radius() * Point2::UnitX();
            if (faces_arc(edge, end)) extend(end.x());
        }
    });
    return {least, greatest};
}

/// To the other side of the axis, with what is bounded still on the left.
void mirror(Profile& profile) {
    for_each_edge(profile, [](ProfileEdge& edge) {
        std::swap(edge.from, edge.to);
        edge.from.x() = -edge.from.x();
        edge.to.x() = -edge.to.x();
        if (edge.centre) edge.centre->x() = -edge.centre->x();
    });
    for (auto& loop : profile) std::ranges::reverse(loop);
}

/// What rounding took apart: heights and distances of corners, and corners off the axis.
void make_exact(Profile& profile, double size) {
    const double tolerance = 8 * std::numeric_limits<double>::epsilon() * size;
    double axis = 0;
    std::vector<double*> distances{&axis}, heights;
    for_each_edge(profile, [&](ProfileEdge& edge) {
        for (Point2* p : {&edge.from, &edge.to}) {
            distances.push_back(&p->x());
            heights.push_back(&p->y());
        }
        if (edge.centre) distances.push_back(&edge.centre->x());
    });
    merge_close_values(distances, tolerance);
    merge_close_values(heights, tolerance);
    for (auto& loop : profile)
        std::erase_if(loop, [](const ProfileEdge& edge) { return !edge.centre && edge.from == edge.to; });
    std::erase_if(profile, [](const auto& loop) { return loop.empty(); });
}

void check_values(Profile& profile) {
    if (profile.empty()) throw InputError("the shape has no area");
    for_each_edge(profile, [](const ProfileEdge& edge) {
        if (!edge.from.allFinite() || !edge.to.allFinite() || (edge.centre && !edge.centre->allFinite()))
            throw InputError("a corner of the shape is not finite");
    });
}

void check_corners(Profile& profile) {
    std::map<std::pair<double, double>, int> seen;
    for_each_edge(profile, [&](const ProfileEdge& edge) {
        if (++seen[{edge.from.x(), edge.from.y()}] > 1)
            throw InputError(
                fmt::format("the shape touches itself at ({}, {})", edge.from.x(), edge.from.y()));
        if (edge.centre && !(edge.radius() > 0)) throw InputError("an arc of the shape has no radius");
    });
}

}  // namespace

std::shared_ptr<const Shape> make_turned(Profile profile, double angle, const Eigen::Affine3d& frame) {
    check_frame(frame);
    if (!(std::abs(angle) > 0 && std::abs(angle) <= 360))
        throw InputError(fmt::format("the angle is {}; it has to be more than 0, and 360 at most", angle));
    check_values(profile);
    const auto [least, greatest] = reach(profile);
    double size = std::max(-least, greatest);
    for_each_edge(profile, [&](const ProfileEdge& edge) { size = std::max(size, std::abs(edge.from.y())); });
    const double on_axis = 1e-12 * std::max(-least, greatest);
    if (least < -on_axis && greatest > on_axis)
        throw InputError("the shape reaches across the axis x = 0, round which it is turned");
    const bool is_left = greatest <= on_axis;
    if (is_left) mirror(profile);
    for_each_edge(profile, [&](ProfileEdge& edge) {
        for (double* x : {&edge.from.x(), &edge.to.x()})
            if (*x <= on_axis) *x = 0;
    });
    make_exact(profile, size);
    check_values(profile);
    check_corners(profile);
    bool has_arcs = false;
    for_each_edge(profile, [&](const ProfileEdge& edge) { has_arcs |= edge.centre.has_value(); });
    if (has_arcs && !is_similarity(frame.linear()))
        throw InputError("what is turned along arcs cannot be scaled differently in x, y and z");

    const double first = (is_left ? 180 : 0) + std::min(angle, 0.0);
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    turn.topLeftCorner<2, 2>() << cos_degrees(first), -sin_degrees(first), sin_degrees(first),
        cos_degrees(first);
    return std::make_shared<Turned>(
        std::move(profile), std::abs(angle),
        angle < 0 ? std::array<std::string, 2>{"end", "start"} : std::array<std::string, 2>{"start", "end"},
        frame * Eigen::Affine3d(turn));
}

}  // namespace maille::modeler
