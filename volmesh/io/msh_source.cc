#include "volmesh/io/msh_source.hh"

#include <array>
#include <cmath>

#include <fmt/core.h>

namespace maille::volmesh::io {

MshSource::MshSource(const InputFile& file) : text_(file) {
    if (next_section() != "MeshFormat") fail("a Gmsh file begins with $MeshFormat");
    const std::string_view version = text_.word("a version");
    if (version != "2.2" && version != "2" && version != "4.1")
        fail(fmt::format("version {} of Gmsh's format cannot be read: save the file as 4.1 or 2.2", version));
    is_version_4_ = version == "4.1";
    const bool is_binary = text_.integer<int>("0 for text or 1 for binary") != 0;
    if (text_.integer<int>("the size of a number") != 8) fail("only numbers of 8 bytes can be read");
    text_.line();
    if (is_binary && raw<std::int32_t>() != 1)
        fail("the file was written by a machine of the other byte order");
    end_section("MeshFormat");
    is_binary_ = is_binary;
}

void MshSource::sizes(std::span<std::uint64_t> numbers, const char* what) {
    if (is_binary_) {
        std::memcpy(numbers.data(), text_.bytes(numbers.size_bytes()).data(), numbers.size_bytes());
    } else {
        for (std::uint64_t& number : numbers) number = size(what);
    }
}

double MshSource::real(const char* what) {
    return is_binary_ ? raw<double>() : text_.real(what);
}

Eigen::Vector3d MshSource::point() {
    if (!is_binary_) return text_.point();
    const auto p = raw<std::array<double, 3>>();
    for (double x : p)
        if (!std::isfinite(x)) fail("a coordinate is not a finite number");
    return {p[0], p[1], p[2]};
}

std::size_t MshSource::count(const char* what, std::size_t numbers_each) {
    return checked(size(what), what, numbers_each);
}

std::size_t MshSource::checked(std::size_t n, const char* what, std::size_t numbers_each) const {
    return text_.checked(n, what, numbers_each * (is_binary_ ? 4 : 2));
}

std::string MshSource::next_section() {
    if (text_.at_end()) return {};
    const std::string_view name = text_.line();
    if (name.front() != '$' || name.starts_with("$End"))
        fail(fmt::format("'{}' stands where a section should begin", name.substr(0, 40)));
    return std::string(name.substr(1));
}

void MshSource::end_section(const std::string& name) {
    const std::string_view end = text_.at_end() ? "" : text_.line();
    if (end != "$End" + name) fail(fmt::format("$End{} should stand here", name));
}

void MshSource::skip_section(const std::string& name) {
    const auto at = text_.rest().find("$End" + name);
    if (at == std::string_view::npos) fail(fmt::format("section ${} has no end", name));
    text_.bytes(at);
    end_section(name);
}

}  // namespace maille::volmesh::io
