#if __has_include(<exodusII.h>)

#include "volmesh/io/exodus_library.hh"

#include <dlfcn.h>
#include <fmt/core.h>

#include "volmesh/error.hh"

namespace maille::volmesh::io {

namespace {

void* opened_library() {
    for (const char* name : {"libexoIIv2c.so.5", "libexodus.so.2", "libexodus.so", "libexoIIv2c.so"})
        if (void* library = ::dlopen(name, RTLD_NOW | RTLD_LOCAL)) return library;
    throw InputError("Exodus files need their library: install libexodusii5");
}

template <class Function>
void find(void* library, const char* name, Function& function) {
    function = reinterpret_cast<Function>(::dlsym(library, name));
    if (!function) throw InputError(fmt::format("Exodus' library has no function {}: it is too old", name));
}

ExodusLibrary loaded_library() {
    void* library = opened_library();
    ExodusLibrary all{};
    find(library, "ex_create_int", all.create);
    find(library, "ex_open_int", all.open);
    find(library, "ex_close", all.close);
    find(library, "ex_opts", all.opts);
    find(library, "ex_get_err", all.get_err);
    find(library, "ex_set_int64_status", all.set_int64_status);
    find(library, "ex_set_max_name_length", all.set_max_name_length);
    find(library, "ex_inquire_int", all.inquire_int);
    find(library, "ex_put_init_ext", all.put_init);
    find(library, "ex_get_init_ext", all.get_init);
    find(library, "ex_put_coord", all.put_coord);
    find(library, "ex_put_coord_names", all.put_coord_names);
    find(library, "ex_get_coord", all.get_coord);
    find(library, "ex_put_block", all.put_block);
    find(library, "ex_get_block", all.get_block);
    find(library, "ex_put_conn", all.put_conn);
    find(library, "ex_get_conn", all.get_conn);
    find(library, "ex_put_set_param", all.put_set_param);
    find(library, "ex_get_set_param", all.get_set_param);
    find(library, "ex_put_set", all.put_set);
    find(library, "ex_get_set", all.get_set);
    find(library, "ex_get_ids", all.get_ids);
    find(library, "ex_put_name", all.put_name);
    find(library, "ex_get_name", all.get_name);
    find(library, "ex_put_id_map", all.put_id_map);
    find(library, "ex_get_id_map", all.get_id_map);
    find(library, "ex_put_info", all.put_info);
    find(library, "ex_get_info", all.get_info);
    all.opts(0);  // it says nothing itself, and does not end the program
    return all;
}

}  // namespace

const ExodusLibrary& exodus_library() {
    static const ExodusLibrary library = loaded_library();
    return library;
}

}  // namespace maille::volmesh::io

#endif
