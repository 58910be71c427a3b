#include "modeler/language_transforms.hh"

#include <Eigen/SVD>
#include <fmt/format.h>

#include "modeler/arguments.hh"
#include "modeler/name_table.hh"
#include "modeler/openscad_facets.hh"

namespace maille::modeler {
namespace {

Eigen::Affine3d linear(const Eigen::Matrix3d& matrix) {
    return Eigen::Affine3d(matrix);
}

Eigen::Affine3d translate(const Node& node, const std::string& file) {
    const Arguments arguments(node, file, {"v"});
    return Eigen::Affine3d(Eigen::Translation3d(arguments.vector("v", 0)));
}

Eigen::Affine3d scale(const Node& node, const std::string& file) {
    const Arguments arguments(node, file, {"v"});
    const Point factors =
        arguments.is_vector("v") ? arguments.vector("v", 1) : Point::Constant(arguments.number("v")).eval();
    return linear(factors.asDiagonal());
}

Eigen::Affine3d mirror(const Node& node, const std::string& file) {
    const Arguments arguments(node, file, {"v"});
    const Point normal = arguments.vector("v", 0);
    if (normal.isZero(0)) throw arguments.error("v", "the normal of the mirror must not be 0");
    return linear(mirror_image(normal));
}

Eigen::Affine3d rotate(const Node& node, const std::string& file) {
    const Arguments arguments(node, file, {"a", "v"});
    if (arguments.is_vector("a")) {
        if (arguments.has("v"))
            throw arguments.error("v", "an axis 'v' goes with one angle 'a', not with three");
        const Point angles = arguments.vector("a", 0);
        return linear(rotation(Point::UnitZ(), angles.z()) * rotation(Point::UnitY(), angles.y()) *
                      rotation(Point::UnitX(), angles.x()));
    }
    const Point axis = arguments.has("v") ? arguments.vector("v", 0) : Point::UnitZ().eval();
    if (axis.isZero(0)) throw arguments.error("v", "the axis of rotation must not be 0");
    return linear(rotation(axis, arguments.number("a")));
}

Eigen::Affine3d multmatrix(const Node& node, const std::string& file) {
    const Arguments arguments(node, file, {"m"});
    const auto& rows = arguments.list("m");
    if (rows.size() != 3 && rows.size() != 4)
        throw arguments.error("m", fmt::format("the matrix must have 4 rows, not {}", rows.size()));
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto& row = arguments.list(rows[i], "m");
        if (row.size() != 4)
            throw arguments.error(rows[i].at,
                                  fmt::format("a row of the matrix must have 4 numbers, not {}", row.size()));
        for (std::size_t j = 0; j < 4; ++j)
            matrix(Eigen::Index(i), Eigen::Index(j)) = arguments.number(row[j], "m");
    }
    if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
        throw arguments.error(rows[3].at, "the last row of the matrix must be [0, 0, 0, 1]");
    return Eigen::Affine3d(matrix);
}

constexpr NameRow<TransformReader> transforms[] = {
    {"multmatrix", multmatrix}, {"translate", translate}, {"rotate", rotate},
    {"scale", scale},           {"mirror", mirror},
};

}  // namespace

TransformReader find_transform(std::string_view name) {
    return look_up(transforms, name);
}

std::vector<std::string_view> transform_names() {
    return names_of(transforms);
}

/// By Rodrigues' formula.
Eigen::Matrix3d rotation(const Point& axis, double degrees) {
    const Point unit = axis.stableNormalized();
    Eigen::Matrix3d cross;
    cross << 0, -unit.z(), unit.y(), unit.z(), 0, -unit.x(), -unit.y(), unit.x(), 0;
    const double cosine = cos_degrees(degrees);
    return cosine * Eigen::Matrix3d::Identity() + sin_degrees(degrees) * cross +
           (1 - cosine) * unit * unit.transpose();
}

Eigen::Matrix3d mirror_image(const Point& normal) {
    const Point unit = normal.stableNormalized();
    return Eigen::Matrix3d::Identity() - 2 * unit * unit.transpose();
}

bool is_regular(const Eigen::Affine3d& map) {
    constexpr double worst_condition = 1e12;
    if (!map.matrix().allFinite()) return false;
    const Eigen::Vector3d stretch = Eigen::JacobiSVD<Eigen::Matrix3d>(map.linear()).singularValues();
    return stretch[2] > 0 && stretch[0] < worst_condition * stretch[2];
}

}  // namespace maille::modeler
