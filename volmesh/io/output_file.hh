#pragma once

#include <charconv>
#include <concepts>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

namespace maille::volmesh::io {

/// A place for a file and, in the same folder, one for writing it until it is whole. What is left beside is
/// removed with the object. Throws InputError, naming the path, where the place cannot be written to.
class PlaceBeside {
  public:
    explicit PlaceBeside(std::filesystem::path path);
    ~PlaceBeside();
    PlaceBeside(const PlaceBeside&) = delete;
    PlaceBeside& operator=(const PlaceBeside&) = delete;

    const std::filesystem::path& path() const { return path_; }
    const std::filesystem::path& temporary() const { return temporary_; }
    /// Puts what is beside in its place.
    void commit();
    /// Throws what the system says of the last error.
    [[noreturn]] void fail() const;

  private:
    std::filesystem::path path_, temporary_;
};

/// A file that is written beside its place and put there by commit(); without it nothing is left.
/// Throws InputError, naming the path, where the folder is missing or the disk is full.
class OutputFile {
  public:
    explicit OutputFile(std::filesystem::path path);
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    OutputFile& operator<<(std::string_view text);
    OutputFile& operator<<(char c);
    OutputFile& operator<<(double value);  ///< the shortest text that reads back as the same number
    template <std::integral T>
    OutputFile& operator<<(T value);

    void write_bytes(const void* data, std::size_t size);
    /// The values as they lie in memory.
    template <class T>
    void write_array(std::span<const T> values) {
        write_bytes(values.data(), values.size_bytes());
    }
    template <class T>
    void write_value(const T& value) {
        write_bytes(&value, sizeof value);
    }

    void commit();

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    /// A place in the buffer with n free bytes; `used_` is to be raised by what is written there.
    char* room_for(std::size_t n);
    void flush();

    PlaceBeside place_;
    std::unique_ptr<std::FILE, Close> file_;
    std::unique_ptr<char[]> buffer_;
    std::size_t used_ = 0;
};

template <std::integral T>
OutputFile& OutputFile::operator<<(T value) {
    constexpr std::size_t longest = 24;
    char* begin = room_for(longest);
    used_ += static_cast<std::size_t>(std::to_chars(begin, begin + longest, value).ptr - begin);
    return *this;
}

}  // namespace maille::volmesh::io
