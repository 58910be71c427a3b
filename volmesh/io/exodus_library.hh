#pragma once

#include <string_view>
#include <utility>

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

/// An open file, which is closed with the object.
class ExodusFile {
  public:
    ExodusFile() = default;
    /// What opening or creating gave: negative where it failed.
    explicit ExodusFile(int id) : id_(id) {}
    ~ExodusFile() { close(); }
    ExodusFile(const ExodusFile&) = delete;
    ExodusFile& operator=(const ExodusFile&) = delete;
    ExodusFile& operator=(ExodusFile&& other) noexcept {
        close();
        id_ = std::exchange(other.id_, -1);
        return *this;
    }

    operator int() const { return id_; }  // NOLINT: it stands for the number in the library's calls
    /// Negative where what was written cannot be kept.
    int close() { return id_ < 0 ? 0 : exodus_library().close(std::exchange(id_, -1)); }

  private:
    int id_ = -1;
};

/// Exodus numbers the sides of a tetrahedron 1 to 4; here by our local face.
inline constexpr int exodus_side[4] = {2, 3, 1, 4};

/// What a file's information says where we wrote it: sets of cells are its element sets, not its blocks, and
/// cells are to come in the order of their numbers.
inline constexpr const char* exodus_mark = "maille: element sets are the sets of cells";

/// So begins a line of information that tells the rule of a set, or a piece of it: what follows is the kind,
/// the set's number and the piece, which a bar ends, as the library takes blanks from ends of lines.
inline constexpr std::string_view exodus_rule_mark = "maille rule ";

}  // namespace maille::volmesh::io
