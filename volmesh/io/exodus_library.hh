#pragma once

#include <exodusII.h>

namespace maille::volmesh::io {

/// The functions of Exodus' library that are used here. The library is loaded when it is first needed: it
/// brings NetCDF, HDF5 and MPI, which no other format wants.
struct ExodusLibrary {
    decltype(&::ex_create_int) create;
    decltype(&::ex_open_int) open;
    decltype(&::ex_close) close;
    decltype(&::ex_opts) opts;
    decltype(&::ex_get_err) get_err;
    decltype(&::ex_set_int64_status) set_int64_status;
    decltype(&::ex_set_max_name_length) set_max_name_length;
    decltype(&::ex_inquire_int) inquire_int;
    decltype(&::ex_put_init_ext) put_init;
    decltype(&::ex_get_init_ext) get_init;
    decltype(&::ex_put_coord) put_coord;
    decltype(&::ex_put_coord_names) put_coord_names;
    decltype(&::ex_get_coord) get_coord;
    decltype(&::ex_put_block) put_block;
    decltype(&::ex_get_block) get_block;
    decltype(&::ex_put_conn) put_conn;
    decltype(&::ex_get_conn) get_conn;
    decltype(&::ex_put_set_param) put_set_param;
    decltype(&::ex_get_set_param) get_set_param;
    decltype(&::ex_put_set) put_set;
    decltype(&::ex_get_set) get_set;
    decltype(&::ex_get_ids) get_ids;
    decltype(&::ex_put_name) put_name;
    decltype(&::ex_get_name) get_name;
    decltype(&::ex_put_id_map) put_id_map;
    decltype(&::ex_get_id_map) get_id_map;
    decltype(&::ex_put_info) put_info;
    decltype(&::ex_get_info) get_info;
};

/// Throws InputError where it is not installed, naming the package.
const ExodusLibrary& exodus_library();

/// Exodus numbers the sides of a tetrahedron 1 to 4; here by our local face.
inline constexpr int exodus_side[4] = {2, 3, 1, 4};

/// What a file's information says where we wrote it: sets of cells are its element sets, not its blocks, and
/// cells are to come in the order of their numbers.
inline constexpr const char* exodus_mark = "maille: element sets are the sets of cells";

}  // namespace maille::volmesh::io
