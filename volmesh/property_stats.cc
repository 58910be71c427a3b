#include "volmesh/property_stats.hh"

#include <cstdlib>
#include <memory>
#include <ostream>

#include <cxxabi.h>
#include <fmt/format.h>

namespace maille::volmesh {
namespace {

const char* rule_name(const BaseProperty& property) {
    if (property.has_own_rule()) return "custom";
    switch (property.rule()) {
        case PropertyRule::none:
            return "none";
        case PropertyRule::copy:
            return "copy";
        case PropertyRule::interpolate:
            return "interpolate";
        case PropertyRule::share:
            return "share";
    }
    return "";
}

}  // namespace

std::string type_name_of(const BaseProperty& property) {
    if (property.type() == typeid(Eigen::Vector3d)) return "Vector3d";
    if (property.type() == typeid(std::string)) return "string";
    int status = 0;
    const std::unique_ptr<char, void (*)(void*)> name(
        abi::__cxa_demangle(property.type().name(), nullptr, nullptr, &status), &std::free);
    return status == 0 ? name.get() : property.type().name();
}

void property_stats(const TetMesh& mesh, std::ostream& out) {
    const std::pair<EntityKind, const char*> kinds[] = {{EntityKind::vertex, "vertex"},
                                                        {EntityKind::edge, "edge"},
                                                        {EntityKind::face, "face"},
                                                        {EntityKind::cell, "cell"}};
    for (const auto& [kind, kind_name] : kinds)
        for (const auto& property : mesh.properties(kind).all())
            if (property)
                out << fmt::format("{} '{}': {} x {}, {}\n", kind_name, property->name(), property->size(),
                                   type_name_of(*property), rule_name(*property));
    for (const auto& property : mesh.mesh_properties().all())
        if (property)
            out << fmt::format("mesh '{}': {} = {}\n", property->name(), type_name_of(*property),
                               property->text(0));
}

}  // namespace maille::volmesh
