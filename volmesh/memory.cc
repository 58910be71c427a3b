#include "volmesh/memory.hh"

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>

#include <sys/mman.h>

namespace maille::volmesh {
namespace {

constexpr std::size_t huge_page = std::size_t{1} << 21U;

std::size_t rounded_up(std::size_t size, std::size_t unit) {
    return (size + unit - 1) / unit * unit;
}

bool is_mapped(std::size_t size) {
    return size >= huge_page;
}

/// Addresses that nothing stands behind yet, from a multiple of the huge page on.
void* reserved_addresses(std::size_t size) {
    constexpr int flags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE;
    void* all = mmap(nullptr, size + huge_page, PROT_NONE, flags, -1, 0);
    if (all == MAP_FAILED) throw std::bad_alloc();
    const auto first = reinterpret_cast<std::uintptr_t>(all);
    const std::size_t before = rounded_up(first, huge_page) - first;
    if (before > 0) munmap(all, before);
    void* aligned = static_cast<char*>(all) + before;
    munmap(static_cast<char*>(aligned) + size, huge_page - before);
    return aligned;
}

void* mapped(std::size_t size) {
    void* block = reserved_addresses(size);
    if (mprotect(block, size, PROT_READ | PROT_WRITE) != 0) {
        munmap(block, size);
        throw std::bad_alloc();
    }
    madvise(block, size, MADV_HUGEPAGE);
    return block;
}

/// Both addresses are multiples of the huge page, so that huge pages move as they are.
void* remapped(void* block, std::size_t old_size, std::size_t size) {
    if (old_size == size) return block;
    void* place = reserved_addresses(size);
    if (mremap(block, old_size, size, MREMAP_MAYMOVE | MREMAP_FIXED, place) == MAP_FAILED) {
        munmap(place, size);
        throw std::bad_alloc();
    }
    return place;
}

void* allocated(std::size_t size) {
    void* block = std::aligned_alloc(memory_alignment, rounded_up(size, memory_alignment));
    if (block == nullptr) throw std::bad_alloc();
    return block;
}

}  // namespace

void* resized_memory(void* block, std::size_t old_size, std::size_t size) {
    if (is_mapped(old_size))
        return remapped(block, rounded_up(old_size, huge_page), rounded_up(size, huge_page));
    void* larger = is_mapped(size) ? mapped(rounded_up(size, huge_page)) : allocated(size);
    if (block != nullptr) std::memcpy(larger, block, old_size);
    std::free(block);
    return larger;
}

void give_back_memory(void* block, std::size_t used, std::size_t size) noexcept {
    if (!is_mapped(size)) return;
    const std::size_t from = rounded_up(used, huge_page), to = rounded_up(size, huge_page);
    if (from < to) madvise(static_cast<char*>(block) + from, to - from, MADV_DONTNEED);
}

void release_memory(void* block, std::size_t size) noexcept {
    if (is_mapped(size))
        munmap(block, rounded_up(size, huge_page));
    else
        std::free(block);
}

}  // namespace maille::volmesh
