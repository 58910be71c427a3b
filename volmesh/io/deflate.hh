#pragma once

#include <span>
#include <string>
#include <string_view>

/// Blocks in zlib's format, packed some four times faster than zlib does and unpacked nearly twice as fast. A
/// block is of less than 4 GB.
namespace maille::volmesh::io {

std::string deflated(std::span<const char> bytes);

/// Fills `to` with what the block was made of. Throws InputError, without naming the file, where the block is
/// damaged or holds another number of bytes.
void inflate_to(std::span<char> to, std::string_view block);

/// So many times larger than a block that which it was made of can be.
inline constexpr std::size_t best_deflation = 1032;

}  // namespace maille::volmesh::io
