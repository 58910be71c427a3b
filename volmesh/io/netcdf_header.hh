#pragma once

#include <cstdint>

#include "volmesh/io/input_file.hh"

namespace maille::volmesh::io {

/// What Exodus' library must be given room for.
struct NetcdfSizes {
    std::uint64_t longest_variable = 0;  ///< number of values
};

/// Texts in Exodus files are no longer than this.
inline constexpr std::uint64_t longest_exodus_text = 4096;

/// Reads the header of a file in NetCDF's classic formats (CDF-1, 2 and 5) and sees that all that it promises
/// is in the file, and that its texts are as short as Exodus' are: the library believes it, would ask for any
/// amount of memory, and reads variables as long as they are, however long they should be. Throws InputError,
/// naming the byte, where it isn't so. (NetCDF User's Guide, appendix B, File Format Specifications.)
NetcdfSizes check_netcdf_header(const InputFile& file);

}  // namespace maille::volmesh::io
