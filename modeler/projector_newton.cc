#include "modeler/projector_newton.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

#include "modeler/shape_plane.hh"

namespace maille::modeler {
namespace {

/// A surface as seen from a point x: its distance, and its normal and curvature at the nearest point.
struct Contact {
    double distance = 0;
    Point normal;
    Eigen::Matrix3d curvature;
};

Contact contact_at(const ShapeFace& target, const Point& x) {
    const Point foot = target.shape->project(target.face, x);
    Contact contact;
    contact.normal = target.shape->face_normal(target.face, foot);
    contact.distance = contact.normal.dot(x - foot);
    contact.curvature = target.shape->face_curvature(target.face, foot);
    return contact;
}

/// The contacts with the most independent normals, at most three, and an orthonormal basis: the first `rank`
/// vectors span the normals (each the normal of one contact less those of the ones before), the others are
/// tangential to all.
struct Independent {
    std::array<const Contact*, 3> contacts;
    Eigen::Matrix3d basis;
    int rank = 0;
    bool touching = false;  ///< nearly parallel: at their common points the surfaces touch rather than cross
};

Independent most_independent(std::span<const Contact> contacts) {
    constexpr double parallel = 1e-9, nearly_parallel = 1e-3;  // angles
    Independent result;
    Eigen::Matrix3d free = Eigen::Matrix3d::Identity();  // projects off the basis so far
    while (result.rank < 3) {
        const auto size_of = [&](const Contact& c) { return (free * c.normal).squaredNorm(); };
        const auto next = std::ranges::max_element(contacts, {}, size_of);
        const double angle = std::sqrt(size_of(*next));
        if (angle < parallel) break;
        result.touching |= angle < nearly_parallel;
        const Point direction = (free * next->normal).normalized();
        result.contacts[result.rank] = &*next;
        result.basis.col(result.rank++) = direction;
        free -= direction * direction.transpose();
    }
    if (result.rank == 1) result.basis.col(1) = result.basis.col(0).unitOrthogonal();
    if (result.rank <= 2) result.basis.col(2) = result.basis.col(0).cross(result.basis.col(1));
    return result;
}

/// The step from x to the stationary point of the distance from p on the contacts' quadratic models.
Point newton_step(const Independent& on, const Point& x, const Point& p, double longest) {
    // The normals in the basis are a lower triangle.
    const auto entry = [&](int i, int j) { return on.contacts[i]->normal.dot(on.basis.col(j)); };
    Point normal_step = Point::Zero();
    for (int i = 0; i < on.rank; ++i) {
        const double rest = -on.contacts[i]->distance - on.contacts[i]->normal.dot(normal_step);
        normal_step += rest / entry(i, i) * on.basis.col(i);
    }
    double curvature = 0;
    for (int i = 0; i < on.rank; ++i) curvature = std::max(curvature, on.contacts[i]->curvature.norm());
    // Further than that along curved surfaces their models are worth nothing.
    const double limit = std::min(longest, curvature > 0 ? 0.5 / curvature : longest);
    const auto limited = [&](const Point& step) {
        return step.norm() > limit ? Point(step * (limit / step.norm())) : step;
    };
    normal_step = limited(normal_step);
    if (on.rank == 3) return normal_step;

    // Multipliers: the normals' parts in p - x; they weigh the curvatures.
    std::array<double, 3> multiplier{};
    for (int i = on.rank; i-- > 0;) {
        multiplier[i] = on.basis.col(i).dot(p - x);
        for (int j = i + 1; j < on.rank; ++j) multiplier[i] -= entry(j, i) * multiplier[j];
        multiplier[i] /= entry(i, i);
    }
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Identity();
    for (int i = 0; i < on.rank; ++i) hessian += multiplier[i] * on.contacts[i]->curvature;
    const Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 2> tangents = on.basis.rightCols(3 - on.rank);
    using Reduced = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2, 2>;
    const Reduced reduced = tangents.transpose() * hessian * tangents;
    constexpr double least_convexity = 0.05;
    const Eigen::SelfAdjointEigenSolver<Reduced> eigen(reduced, Eigen::EigenvaluesOnly);
    const bool convex = eigen.eigenvalues()[0] > least_convexity;
    Point tangential_step;
    if (convex)
        tangential_step =
            tangents * reduced.inverse() * tangents.transpose() * (p - x - hessian * normal_step);
    else
        tangential_step = tangents * (tangents.transpose() * (p - x));
    return normal_step + limited(tangential_step);
}

double farthest(std::span<const ShapeFace> faces, const Point& x) {
    double distance = 0;
    for (const ShapeFace& target : faces)
        distance = std::max(distance, (x - target.shape->project(target.face, x)).norm());
    return distance;
}

/// Axis-aligned planes hold their coordinate to the last bit.
Point snap_to_planes(std::span<const ShapeFace> faces, Point x) {
    for (const ShapeFace& target : faces)
        if (target.shape->faces()[target.face].planar &&
            target.shape->face_normal(target.face, x).cwiseAbs().maxCoeff() == 1)
            x = target.shape->project(target.face, x);
    return x;
}

/// Newton's method from `start`.
std::optional<Point> search(std::span<const ShapeFace> faces, const Point& start, const Point& p,
                            double size) {
    constexpr int most_iterations = 100;
    const double rounding = rounding_at(p, size);
    std::vector<Contact> contacts(faces.size());
    Point x = start;
    double last_step = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        double distance = 0;
        for (std::size_t i = 0; i < faces.size(); ++i) {
            contacts[i] = contact_at(faces[i], x);
            distance = std::max(distance, std::abs(contacts[i].distance));
        }
        const Independent independent = most_independent(contacts);
        // Where surfaces touch, Newton's method halves the error at every step and has no end.
        if (independent.touching && distance <= rounding)
            last_step = 0;
        else {
            const Point step = newton_step(independent, x, p, size / 4);
            x += step;
            if (!x.allFinite() || (x - p).norm() > size) return std::nullopt;
            const double previous = std::exchange(last_step, step.norm());
            if (last_step <= 1e-13 * size && last_step > previous / 2) break;
        }
        if (last_step <= rounding) break;
    }
    x = snap_to_planes(faces, x);
    if (last_step > 1e-9 * size || farthest(faces, x) > std::max(1e-12 * size, rounding)) return std::nullopt;
    return x;
}

}  // namespace

std::optional<Point> nearest_common_point(std::span<const ShapeFace> faces, const Point& p, double size) {
    if (farthest(faces, p) <= rounding_at(p, size)) return p;
    if (const auto found = search(faces, p, p, size)) return found;
    // From projections in turn, which come closer slowly but surely.
    constexpr int most_turns = 20;
    Point x = p;
    for (int turn = 0; turn < most_turns; ++turn)
        for (const ShapeFace& target : faces) x = target.shape->project(target.face, x);
    return search(faces, x, p, size);
}

}  // namespace maille::modeler
