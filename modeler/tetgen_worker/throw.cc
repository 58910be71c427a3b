#include <cstdio>
#include <cstdlib>
#include <typeinfo>

#include <unistd.h>

#include "modeler/tetgen_worker/status.hh"

// TetGen throws its error numbers from under objects that it has half destroyed, so that unwinding crashes.
// No exception is caught in this program: the process ends where one is thrown, and tells by its status
// which.
extern "C" [[noreturn]] void __cxa_throw(void* object, std::type_info* type, void (*)(void*)) {
    if (*type == typeid(int))
        _exit(maille::modeler::tetgen::tetgen_error_status + *static_cast<int*>(object));
    std::fprintf(stderr, "uncaught %s\n", type->name());
    std::abort();
}
