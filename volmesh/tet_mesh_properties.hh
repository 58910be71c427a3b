#pragma once

// Included by tet_mesh.hh.

namespace maille::volmesh {

template <class Entity>
constexpr EntityKind TetMesh::kind_of() {
    if constexpr (std::same_as<Entity, VertexHandle>) return EntityKind::vertex;
    if constexpr (std::same_as<Entity, EdgeHandle>) return EntityKind::edge;
    if constexpr (std::same_as<Entity, FaceHandle>) return EntityKind::face;
    return EntityKind::cell;
}

template <class Entity>
PropertyList& TetMesh::list_of() const {
    if constexpr (std::same_as<Entity, MeshHandle>) {
        return mesh_properties_;
    } else {
        return properties_of(kind_of<Entity>());
    }
}

template <class Entity, class T>
Property<T>& TetMesh::values(PropertyHandle<Entity, T> ph) const {
    return static_cast<Property<T>&>(list_of<Entity>().at(ph.idx()));
}

/// The property gets a value for every entity there is, and keeps pace with every edit; its rule says what
/// split entities get. Throws std::invalid_argument where the kind has a property of that name, or the rule
/// doesn't suit it.
template <class Entity, class T>
void TetMesh::add_property(PropertyHandle<Entity, T>& ph, const std::string& name,
                           std::type_identity_t<PropertyHeritage<T>> heritage,
                           std::type_identity_t<T> default_value) {
    constexpr EntityKind kind = kind_of<Entity>();
    constexpr bool is_vertex = kind == EntityKind::vertex;
    const PropertyRule rule = heritage.rule;
    if (rule == (is_vertex ? PropertyRule::share : PropertyRule::interpolate))
        throw std::invalid_argument("property '" + name +
                                    "': only vertices interpolate, and all others share");
    if (rule != PropertyRule::copy && rule != PropertyRule::none && !Property<T>::is_linear)
        throw std::invalid_argument("property '" + name +
                                    "': values of this type cannot be interpolated or shared");
    if constexpr (kind == EntityKind::edge) request_edges();
    if constexpr (kind == EntityKind::face) request_faces();
    auto made = std::make_unique<Property<T>>(name, std::move(heritage), std::move(default_value));
    made->resize(n_indices(kind));
    ph = PropertyHandle<Entity, T>(properties_of(kind).add(std::move(made)));
}

/// Whether there is a property of that name and type; `ph` is set, or made invalid.
template <class Entity, class T>
bool TetMesh::get_property_handle(PropertyHandle<Entity, T>& ph, const std::string& name) const {
    ph = PropertyHandle<Entity, T>(list_of<Entity>().find(name, typeid(T)));
    return ph.is_valid();
}

template <class Entity, class T>
void TetMesh::remove_property(PropertyHandle<Entity, T>& ph) {
    list_of<Entity>().remove(ph.idx());
    ph.invalidate();
}

template <class Entity, class T>
typename Property<T>::Stored& TetMesh::property(PropertyHandle<Entity, T> ph,
                                                std::type_identity_t<Entity> h) {
    return values(ph)[h.idx()];
}

template <class Entity, class T>
const typename Property<T>::Stored& TetMesh::property(PropertyHandle<Entity, T> ph,
                                                      std::type_identity_t<Entity> h) const {
    return values(ph)[h.idx()];
}

/// Throws std::invalid_argument where the mesh has a property of that name.
template <class T>
void TetMesh::add_property(MPropHandleT<T>& ph, const std::string& name, std::type_identity_t<T> value) {
    auto made = std::make_unique<Property<T>>(name, PropertyRule::copy, std::move(value));
    made->resize(1);
    ph = MPropHandleT<T>(mesh_properties_.add(std::move(made)));
}

template <class T>
typename Property<T>::Stored& TetMesh::property(MPropHandleT<T> ph) {
    return values(ph)[0];
}

template <class T>
const typename Property<T>::Stored& TetMesh::property(MPropHandleT<T> ph) const {
    return values(ph)[0];
}

template <class Entity>
void TetMesh::request_status() {
    constexpr auto kind = static_cast<int>(kind_of<Entity>());
    if (status_requests_[kind]++ > 0) return;
    PropertyHandle<Entity, StatusBits> ph;
    if (!get_property_handle(ph, "status")) add_property(ph, "status");
    status_property_[kind] = ph.idx();
}

/// Throws std::logic_error where there was no request.
template <class Entity>
void TetMesh::release_status() {
    constexpr auto kind = static_cast<int>(kind_of<Entity>());
    if (status_requests_[kind] == 0)
        throw std::logic_error("marks are released more often than they were requested");
    if (--status_requests_[kind] == 0) list_of<Entity>().remove(status_property_[kind]);
}

template <class Entity>
StatusBits* TetMesh::status_bits(Entity h) const {
    if (!has_status<Entity>()) return nullptr;
    const std::uint32_t place = status_property_[static_cast<int>(kind_of<Entity>())];
    return &values(PropertyHandle<Entity, StatusBits>(place))[h.idx()];
}

}  // namespace maille::volmesh
