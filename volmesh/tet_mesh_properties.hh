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

template <class Entity, class T>
Property<T>& TetMesh::values(PropertyHandle<Entity, T> ph) const {
    return static_cast<Property<T>&>(properties_of(kind_of<Entity>()).at(ph.idx()));
}

/// The property gets a value for every entity there is, and keeps pace with every edit; its rule says what
/// split entities get. Throws std::invalid_argument where the kind has a property of that name, or the rule
/// doesn't suit it.
template <class Entity, class T>
void TetMesh::add_property(PropertyHandle<Entity, T>& ph, const std::string& name,
                           PropertyHeritage<T> heritage, T default_value) {
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
    ph = PropertyHandle<Entity, T>(properties_of(kind_of<Entity>()).find(name, typeid(T)));
    return ph.is_valid();
}

template <class Entity, class T>
void TetMesh::remove_property(PropertyHandle<Entity, T>& ph) {
    properties_of(kind_of<Entity>()).remove(ph.idx());
    ph.invalidate();
}

template <class Entity, class T>
typename Property<T>::Stored& TetMesh::property(PropertyHandle<Entity, T> ph, Entity h) {
    return values(ph)[h.idx()];
}

template <class Entity, class T>
const typename Property<T>::Stored& TetMesh::property(PropertyHandle<Entity, T> ph, Entity h) const {
    return values(ph)[h.idx()];
}

}  // namespace maille::volmesh
