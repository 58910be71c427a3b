// The parser of models on any text.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "modeler/parser.hh"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        maille::modeler::parse({reinterpret_cast<const char*>(data), size}, "a.csg");
    } catch (const maille::InputError& error) {
        if (!std::string_view(error.what()).starts_with("a.csg:")) std::abort();
    }
    return 0;
}
