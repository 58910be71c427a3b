#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace maille::html {

/// Arrays of whole numbers for the page, one after the other. Each is stored as planes: first the lowest byte
/// of every number, then the next; which compresses well. `page/data.js` reads them.
class Blob {
  public:
    /// Numbers as they are.
    void add(const std::string& name, const std::vector<std::uint32_t>& numbers);
    /// Each number as its difference from the one `stride` before it, the sign in the lowest bit.
    void add_differences(const std::string& name, const std::vector<std::uint32_t>& numbers,
                         std::size_t stride);
    /// Numbers that name things in the order of their first use: each as how far it is below the first one
    /// not yet used. Precondition: no number but that one is greater than all before.
    void add_by_first_use(const std::string& name, const std::vector<std::uint32_t>& numbers);

    /// By name: {count, width, stride, by}, in the order in which they lie.
    const nlohmann::ordered_json& contents() const { return contents_; }
    std::string_view bytes() const { return bytes_; }

  private:
    void append(const std::string& name, const std::vector<std::uint32_t>& numbers, const char* by,
                std::size_t stride);

    nlohmann::ordered_json contents_ = nlohmann::ordered_json::object();
    std::string bytes_;
};

/// Compressed by zlib, as text of base 64.
std::string compressed_base64(std::string_view bytes);

}  // namespace maille::html
