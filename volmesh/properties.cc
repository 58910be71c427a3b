#include "volmesh/properties.hh"

#include <stdexcept>

namespace maille::volmesh {

PropertyList::PropertyList(const PropertyList& other) {
    properties_.reserve(other.properties_.size());
    for (const auto& property : other.properties_)
        properties_.push_back(property ? property->clone() : nullptr);
}

PropertyList& PropertyList::operator=(const PropertyList& other) {
    PropertyList copy(other);
    return *this = std::move(copy);
}

std::uint32_t PropertyList::add(std::unique_ptr<BaseProperty> property) {
    for (const auto& there : properties_)
        if (there && there->name() == property->name())
            throw std::invalid_argument("there is a property '" + property->name() + "' already");
    properties_.push_back(std::move(property));
    return static_cast<std::uint32_t>(properties_.size() - 1);
}

// The place stays empty, so that the handles of the others stay true.
void PropertyList::remove(std::uint32_t i) {
    properties_.at(i).reset();
}

std::uint32_t PropertyList::find(const std::string& name, const std::type_info& type) const {
    for (std::uint32_t i = 0; i < properties_.size(); ++i)
        if (properties_[i] && properties_[i]->name() == name && properties_[i]->type() == type) return i;
    return VertexHandle::invalid_index;
}

bool PropertyList::empty() const {
    return std::ranges::none_of(properties_, [](const auto& property) { return property != nullptr; });
}

}  // namespace maille::volmesh
