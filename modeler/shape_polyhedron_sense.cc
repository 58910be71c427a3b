#include "modeler/shape_polyhedron_sense.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "modeler/shape_polyhedron.hh"
#include "volmesh/error.hh"

namespace maille::modeler {
namespace {

using Faces = std::vector<PolyhedronFace>;

/// A face beyond an edge, and whether it passes the edge in the same sense.
struct Neighbour {
    std::uint32_t face;
    bool same_sense;
};

std::vector<std::vector<Neighbour>> neighbours_of(const Faces& faces) {
    struct Use {
        std::uint32_t face;
        bool forward;
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Use>> uses;
    for (std::uint32_t f = 0; f < faces.size(); ++f)
        for (const auto& loop : faces[f].loops)
            for (std::size_t k = 0; k < loop.size(); ++k) {
                const std::uint32_t a = loop[k], b = loop[(k + 1) % loop.size()];
                uses[std::minmax(a, b)].push_back({f, a < b});
            }
    std::vector<std::vector<Neighbour>> result(faces.size());
    for (const auto& [edge, both] : uses) {
        if (both.size() != 2) continue;
        const bool same = both[0].forward == both[1].forward;
        result[both[0].face].push_back({both[1].face, same});
        result[both[1].face].push_back({both[0].face, same});
    }
    return result;
}

void turn_round(PolyhedronFace& face) {
    for (auto& loop : face.loops) std::ranges::reverse(loop);
}

/// The faces that hang together with the first one, and which of them are turned against it.
struct Piece {
    std::vector<std::uint32_t> faces;
    std::vector<std::uint32_t> against;
    bool has_two_sides = true;
};

std::vector<Piece> pieces_of(const Faces& faces) {
    const auto neighbours = neighbours_of(faces);
    enum : std::uint8_t { unseen, with, against };
    std::vector<std::uint8_t> sense(faces.size(), unseen);
    std::vector<Piece> pieces;
    for (std::uint32_t first = 0; first < faces.size(); ++first) {
        if (sense[first] != unseen) continue;
        Piece& piece = pieces.emplace_back();
        piece.faces.push_back(first);
        sense[first] = with;
        for (std::size_t i = 0; i < piece.faces.size(); ++i) {
            const std::uint32_t f = piece.faces[i];
            if (sense[f] == against) piece.against.push_back(f);
            for (const auto& [other, same_sense] : neighbours[f]) {
                const std::uint8_t wanted = (sense[f] == with) != same_sense ? with : against;
                if (sense[other] == unseen) {
                    sense[other] = wanted;
                    piece.faces.push_back(other);
                } else if (sense[other] != wanted) {
                    piece.has_two_sides = false;
                }
            }
        }
    }
    return pieces;
}

/// Six times the volume that the faces enclose; only differences matter where they are not closed.
double volume(const std::vector<Point>& points, const Faces& faces, std::span<const std::uint32_t> of,
              const Point& origin) {
    double sum = 0;
    for (const std::uint32_t f : of)
        sum += area_vector(points, faces[f].loops).dot(points[faces[f].loops.front().front()] - origin);
    return sum;
}

Eigen::AlignedBox3d box_of(const std::vector<Point>& points, const Faces& faces,
                           std::span<const std::uint32_t> of) {
    Eigen::AlignedBox3d box;
    for (const std::uint32_t f : of)
        for (const auto& loop : faces[f].loops)
            for (const std::uint32_t vertex : loop) box.extend(points[vertex]);
    return box;
}

}  // namespace

void agree_on_sense(Faces& faces) {
    for (const Piece& piece : pieces_of(faces)) {
        if (!piece.has_two_sides || piece.against.empty()) continue;
        const bool most_are_against = 2 * piece.against.size() > piece.faces.size();
        if (most_are_against)
            for (const std::uint32_t f : piece.faces) turn_round(faces[f]);
        for (const std::uint32_t f : piece.against) turn_round(faces[f]);
    }
}

void turn_outwards(const std::vector<Point>& points, Faces& faces) {
    const std::vector<Piece> pieces = pieces_of(faces);
    Eigen::AlignedBox3d all;
    std::vector<Eigen::AlignedBox3d> boxes;
    for (const Piece& piece : pieces) all.extend(boxes.emplace_back(box_of(points, faces, piece.faces)));
    double total = 0, most = 0;
    for (const Piece& piece : pieces) {
        const double enclosed = volume(points, faces, piece.faces, all.center());
        total += enclosed;
        most = std::max(most, std::abs(enclosed));
    }
    if (!(most > 6e-14 * std::pow(all.diagonal().norm(), 3)))
        throw InputError("the polyhedron encloses no volume");
    if (total < 0)
        for (PolyhedronFace& face : faces) turn_round(face);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const bool within = std::ranges::any_of(
            boxes, [&](const auto& box) { return &box != &boxes[i] && box.contains(boxes[i]); });
        if (within || !(volume(points, faces, pieces[i].faces, all.center()) < 0)) continue;
        for (const std::uint32_t f : pieces[i].faces) turn_round(faces[f]);
    }
}

}  // namespace maille::modeler
