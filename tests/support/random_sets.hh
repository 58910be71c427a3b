#pragma once

#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <unistd.h>

#include "volmesh/tet_mesh.hh"

namespace maille::test {

/// A folder of its own that is gone with the object.
class TemporaryFolder {
  public:
    TemporaryFolder()
        : path_(std::filesystem::temp_directory_path() / ("maille-test-" + std::to_string(::getpid()))) {
        std::filesystem::create_directories(path_);
    }
    ~TemporaryFolder() { std::filesystem::remove_all(path_); }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// Moves the inner vertices a little, so that coordinates have all their digits.
inline void shake(volmesh::TetMesh& mesh, double distance, std::mt19937& random) {
    std::uniform_real_distribution<double> shift(-distance, distance);
    for (auto v : mesh.vertices()) {
        const volmesh::Point p = mesh.point(v);
        mesh.set_point(v, p + volmesh::Point(shift(random), shift(random), shift(random)));
    }
}

/// Two overlapping sets of each kind with random members, an empty set, and sets of one name in all kinds.
inline void add_random_sets(volmesh::TetMesh& mesh, std::mt19937& random) {
    using volmesh::EntityKind;
    std::bernoulli_distribution is_in(0.2);
    for (const std::string name : {"plate/x+", "steel & \xc3\xa9t\xc3\xa9", "same"}) {
        const auto cells = mesh.add_set(name == "same" ? name : name + " cells", EntityKind::cell);
        const auto faces = mesh.add_set(name == "same" ? name : name + " faces", EntityKind::face);
        const auto edges = mesh.add_set(name == "same" ? name : name + " edges", EntityKind::edge);
        const auto vertices = mesh.add_set(name == "same" ? name : name + " vertices", EntityKind::vertex);
        for (auto c : mesh.cells()) {
            if (is_in(random)) mesh.insert(cells, c);
            for (int f = 0; f < 4; ++f)
                if (is_in(random)) mesh.insert(faces, volmesh::TetMesh::halfface(c, f));
            for (int e = 0; e < 6; ++e)
                if (is_in(random)) mesh.insert(edges, c, e);
        }
        for (auto v : mesh.vertices())
            if (is_in(random)) mesh.insert(vertices, v);
    }
    mesh.add_set("nobody", EntityKind::face);
}

}  // namespace maille::test
