#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>

/// What the program passes to `maille-tetgen` and gets back: vectors of plain numbers, each behind its
/// length, in the byte order of the machine.
namespace maille::modeler::tetgen {

struct Request {
    std::string switches;       ///< as on TetGen's command line
    double processor_time = 0;  ///< seconds that the worker may compute
    std::vector<Eigen::Vector3d> points;
    std::vector<std::array<std::uint32_t, 3>> facets;
    /// Of each facet: the regions in front of it (right-hand rule) and behind. Negative ones are left empty.
    /// Nothing where the whole is one region.
    std::vector<std::array<std::int32_t, 2>> sides;
    std::vector<double> max_volumes;  ///< of a tetrahedron, by region
};

struct Answer {
    std::vector<Eigen::Vector3d> points;                  ///< the request's come first
    std::vector<std::array<std::uint32_t, 4>> cells;      ///< (v1-v0)x(v2-v0).(v3-v0) > 0
    std::vector<std::array<std::uint32_t, 4>> neighbors;  ///< across the face opposite each vertex; `no_cell`
    std::vector<std::array<std::uint32_t, 3>> facets;  ///< the cells' faces that lie on the request's facets
    std::vector<std::uint32_t> parents;  ///< the request's facet that each of these is a part of
};

inline constexpr std::uint32_t no_cell = 0xffffffff;

class Packer {
  public:
    template <class Vector>
    void operator()(const Vector& values) {
        const std::uint64_t count = values.size();
        append(&count, sizeof count);
        append(values.data(), count * sizeof(*values.data()));
    }
    void operator()(double value) { append(&value, sizeof value); }

    std::vector<char> bytes;

  private:
    void append(const void* data, std::size_t size) {
        const char* begin = static_cast<const char*>(data);
        bytes.insert(bytes.end(), begin, begin + size);
    }
};

/// Throws std::runtime_error where the bytes end early.
class Unpacker {
  public:
    explicit Unpacker(std::span<const char> bytes) : rest_(bytes) {}

    template <class Vector>
    void operator()(Vector& values) {
        std::uint64_t count = 0;
        take(&count, sizeof count);
        if (count > rest_.size() / sizeof(*values.data())) throw std::runtime_error("incomplete data");
        values.resize(count);
        take(values.data(), count * sizeof(*values.data()));
    }
    void operator()(double& value) { take(&value, sizeof value); }

  private:
    void take(void* data, std::size_t size) {
        if (size > rest_.size()) throw std::runtime_error("incomplete data");
        if (size > 0) std::memcpy(data, rest_.data(), size);
        rest_ = rest_.subspan(size);
    }

    std::span<const char> rest_;
};

template <class Archive, class RequestType>
void visit_request(Archive& archive, RequestType& r) {
    archive(r.switches);
    archive(r.processor_time);
    archive(r.points);
    archive(r.facets);
    archive(r.sides);
    archive(r.max_volumes);
}

template <class Archive, class AnswerType>
void visit_answer(Archive& archive, AnswerType& a) {
    archive(a.points);
    archive(a.cells);
    archive(a.neighbors);
    archive(a.facets);
    archive(a.parents);
}

/// The worker reads its request from standard input and writes the answer here; standard output and error
/// take what TetGen prints.
inline constexpr int answer_descriptor = 3;

}  // namespace maille::modeler::tetgen
