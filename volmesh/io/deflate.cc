#include "volmesh/io/deflate.hh"

#include <memory>
#include <new>
#include <stdexcept>
#include <vector>

#include <isa-l/igzip_lib.h>
#include <libdeflate.h>

#include "volmesh/error.hh"

namespace maille::volmesh::io {

// ISA-L packs fastest, libdeflate unpacks as fast as it and notices every damage.

std::string deflated(std::span<const char> bytes) {
    thread_local std::vector<std::uint8_t> workspace(ISAL_DEF_LVL1_DEFAULT);
    // What doesn't pack is stored, in pieces of 64 KiB with their heads.
    std::string out(bytes.size() + bytes.size() / 1024 + 1024, '\0');
    isal_zstream stream;
    isal_deflate_stateless_init(&stream);
    stream.gzip_flag = IGZIP_ZLIB;
    stream.level = 1;
    stream.level_buf = workspace.data();
    stream.level_buf_size = static_cast<std::uint32_t>(workspace.size());
    stream.end_of_stream = 1;
    stream.next_in = reinterpret_cast<std::uint8_t*>(const_cast<char*>(bytes.data()));  // only reads
    stream.avail_in = static_cast<std::uint32_t>(bytes.size());
    stream.next_out = reinterpret_cast<std::uint8_t*>(out.data());
    stream.avail_out = static_cast<std::uint32_t>(out.size());
    if (isal_deflate_stateless(&stream) != COMP_OK) throw std::logic_error("a block cannot be packed");
    out.resize(stream.total_out);
    return out;
}

void inflate_to(std::span<char> to, std::string_view block) {
    thread_local const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>
        decompressor(libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
    if (!decompressor) throw std::bad_alloc();
    const auto status = libdeflate_zlib_decompress(decompressor.get(), block.data(), block.size(), to.data(),
                                                   to.size(), nullptr);
    if (status != LIBDEFLATE_SUCCESS) throw InputError("a compressed block is damaged");
}

}  // namespace maille::volmesh::io
