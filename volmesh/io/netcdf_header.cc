#include "volmesh/io/netcdf_header.hh"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <fmt/core.h>

namespace maille::volmesh::io {

namespace {

enum Tag : std::uint64_t { absent = 0, dimension = 0x0A, variable = 0x0B, attribute = 0x0C };

/// Big-endian numbers from front to back.
class NetcdfHeader {
  public:
    explicit NetcdfHeader(const InputFile& file) : file_(file), text_(file.text()) {}

    NetcdfSizes check();

  private:
    [[noreturn]] void fail(const std::string& message) const {
        file_.fail_at_byte(text_.data() + at_, message);
    }
    std::uint64_t number(std::size_t n_bytes);
    /// A count or size: 8 bytes wide in CDF-5, else 4.
    std::uint64_t size() { return number(version_ == 5 ? 8 : 4); }
    void skip(std::uint64_t n_bytes);
    std::string_view name();
    /// How many entries the list has, each of at least that many bytes.
    std::uint64_t list(Tag tag, std::uint64_t bytes_each);
    std::uint64_t bytes_of_type();
    void check_dimensions();
    void skip_attributes();
    void check_variable();

    const InputFile& file_;
    std::string_view text_;
    std::size_t at_ = 0;
    int version_ = 0;
    std::uint64_t n_records_ = 0;
    std::vector<std::uint64_t> dimensions_;
    NetcdfSizes sizes_;
};

std::uint64_t NetcdfHeader::number(std::size_t n_bytes) {
    if (n_bytes > text_.size() - at_) fail("the file ends within its header");
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < n_bytes; ++i)
        value = value << 8U | static_cast<unsigned char>(text_[at_ + i]);
    at_ += n_bytes;
    return value;
}

/// With what fills the last four bytes.
void NetcdfHeader::skip(std::uint64_t n_bytes) {
    const std::uint64_t padded = (n_bytes + 3) / 4 * 4;
    if (n_bytes > text_.size() || padded > text_.size() - at_) fail("the file ends within its header");
    at_ += padded;
}

std::string_view NetcdfHeader::name() {
    const std::uint64_t n = size();
    const std::size_t begin = at_;
    skip(n);
    return text_.substr(begin, n);
}

std::uint64_t NetcdfHeader::list(Tag tag, std::uint64_t bytes_each) {
    const std::uint64_t found = number(4);
    const std::uint64_t n = size();
    if (found != tag && (found != absent || n != 0)) fail("a list of another kind should stand here");
    if (n > (text_.size() - at_) / bytes_each)
        fail(fmt::format("a list is said to have {} entries, more than the file can hold", n));
    return n;
}

std::uint64_t NetcdfHeader::bytes_of_type() {
    constexpr std::array<std::uint64_t, 12> bytes{0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
    const std::uint64_t type = number(4);
    if (type < 1 || type >= bytes.size()) fail(fmt::format("there is no type {}", type));
    return bytes[type];
}

void NetcdfHeader::check_dimensions() {
    const std::uint64_t n = list(dimension, 8);
    for (std::uint64_t i = 0; i < n; ++i) {
        const bool is_of_text = name().starts_with("len_");
        dimensions_.push_back(size());
        if (is_of_text && dimensions_.back() > longest_exodus_text)
            fail(fmt::format("texts of {} bytes are too long", dimensions_.back()));
        if (dimensions_.back() > text_.size())
            fail(
                fmt::format("a dimension is said to be {}, more than the file can hold", dimensions_.back()));
    }
}

void NetcdfHeader::skip_attributes() {
    const std::uint64_t n = list(attribute, 12);
    for (std::uint64_t i = 0; i < n; ++i) {
        const std::string_view what = name();
        const std::uint64_t bytes_each = bytes_of_type();
        const std::uint64_t n_values = size();
        if (n_values > text_.size()) fail("an attribute has more values than the file can hold");
        // The library has room for so much of a title.
        if (n_values > (what == "title" ? 80 : longest_exodus_text)) fail("an attribute is too long");
        skip(n_values * bytes_each);
    }
}

void NetcdfHeader::check_variable() {
    name();
    const std::uint64_t n_dimensions = size();
    if (n_dimensions > dimensions_.size()) fail("a variable has more dimensions than there are");
    std::uint64_t n_values = 1;
    for (std::uint64_t k = 0; k < n_dimensions; ++k) {
        const std::uint64_t which = size();
        if (which >= dimensions_.size()) fail("a variable has a dimension that there is not");
        // The unlimited one, of records, is said to be 0.
        const std::uint64_t length = dimensions_[which] == 0 ? n_records_ : dimensions_[which];
        if (length != 0 && n_values > text_.size() / length) fail("a variable is larger than the file");
        n_values *= length;
    }
    sizes_.longest_variable = std::max(sizes_.longest_variable, n_values);
    skip_attributes();
    const std::uint64_t n_bytes = n_values * bytes_of_type();
    size();  // the size as it is said, which may be wrong even in good files
    const std::uint64_t begin = number(version_ == 1 ? 4 : 8);
    if (begin > text_.size() || n_bytes > text_.size() - begin)
        fail(fmt::format("a variable of {} bytes from byte {} on is not in the file", n_bytes, begin));
}

NetcdfSizes NetcdfHeader::check() {
    at_ = 3;  // "CDF"
    version_ = static_cast<int>(number(1));
    if (version_ != 1 && version_ != 2 && version_ != 5) fail(fmt::format("there is no CDF-{}", version_));
    n_records_ = size();
    if (n_records_ > text_.size())
        fail(fmt::format("{} records are more than the file can hold", n_records_));
    check_dimensions();
    skip_attributes();
    const std::uint64_t n = list(variable, 28);
    for (std::uint64_t i = 0; i < n; ++i) check_variable();
    return sizes_;
}

}  // namespace

NetcdfSizes check_netcdf_header(const InputFile& file) {
    return NetcdfHeader(file).check();
}

}  // namespace maille::volmesh::io
