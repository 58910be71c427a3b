#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "volmesh/io/text_scanner.hh"

namespace maille::volmesh::io {

/// The numbers of a Gmsh file, whichever way they are written: headers are text, what lies in sections text
/// or binary.
class MshSource {
  public:
    /// Reads $MeshFormat.
    explicit MshSource(const InputFile& file);

    bool is_version_4() const { return is_version_4_; }
    bool is_binary() const { return is_binary_; }

    std::int32_t integer(const char* what) { return number<std::int32_t>(what); }
    std::uint64_t size(const char* what) { return number<std::uint64_t>(what); }
    /// As many as there is place for.
    void sizes(std::span<std::uint64_t> numbers, const char* what);
    double real(const char* what);
    /// Finite coordinates.
    Eigen::Vector3d point();
    /// A number of items that the rest of the file can hold, if each has that many numbers (of at least 4
    /// bytes).
    std::size_t count(const char* what, std::size_t numbers_each);
    std::size_t checked(std::size_t n, const char* what, std::size_t numbers_each) const;

    /// The name of the next section, without its $; empty at the end of the file.
    std::string next_section();
    void end_section(const std::string& name);
    void skip_section(const std::string& name);

    TextScanner& text() { return text_; }
    [[noreturn]] void fail(const std::string& message) const { text_.fail(message); }

  private:
    template <class T>
    T raw();
    template <class T>
    T number(const char* what) {
        return is_binary_ ? raw<T>() : text_.integer<T>(what);
    }

    TextScanner text_;
    bool is_version_4_ = false;
    bool is_binary_ = false;
};

template <class T>
T MshSource::raw() {
    T value;
    std::memcpy(&value, text_.bytes(sizeof value).data(), sizeof value);
    return value;
}

}  // namespace maille::volmesh::io
