#pragma once

#include <cstddef>

namespace maille::volmesh {

/// Where blocks of memory begin: at multiples of a line of the processor's cache.
inline constexpr std::size_t memory_alignment = 64;

/// A block of `size` bytes (more than 0, more than before) with what was in the old one, which is gone. Give
/// the null pointer and 0 for a first one. Blocks of 2 MiB and more lie in huge pages where the system has
/// them, and are moved without copying. Throws std::bad_alloc, the old block untouched.
void* resized_memory(void* block, std::size_t old_size, std::size_t size);
/// Lets the system have what lies behind the first `used` bytes of a block, in whole huge pages: the block
/// keeps its size, but what was there is lost.
void give_back_memory(void* block, std::size_t used, std::size_t size) noexcept;
/// Gives a block back, or nothing where it is the null pointer; the size is that which was asked for.
void release_memory(void* block, std::size_t size) noexcept;

}  // namespace maille::volmesh
