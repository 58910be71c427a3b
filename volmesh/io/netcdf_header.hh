#pragma once

#include "volmesh/io/input_file.hh"

namespace maille::volmesh::io {

/// Reads the header of a file in NetCDF's classic formats (CDF-1, 2 and 5) and sees that all that it promises
/// is in the file: the library believes it, and would ask for any amount of memory. Throws InputError, naming
/// the byte, where it isn't so. (NetCDF User's Guide, appendix B, File Format Specifications.)
void check_netcdf_header(const InputFile& file);

}  // namespace maille::volmesh::io
