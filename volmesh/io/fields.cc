#include "volmesh/io/fields.hh"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include <fmt/core.h>

#include "volmesh/error.hh"

namespace maille::volmesh::io {

namespace {

template <class T>
void append(std::vector<double>& values, const T& value) {
    if constexpr (std::is_arithmetic_v<T>) {
        values.push_back(static_cast<double>(value));
    } else {
        values.insert(values.end(), value.begin(), value.end());
    }
}

/// Of edges or faces: their numbers in the order in which one comes to them cell by cell.
template <std::size_t N, class NumberOf>
std::vector<std::uint32_t> order_by_cells(const TetMesh& mesh, std::size_t n, const NumberOf& number_of) {
    std::vector<std::uint8_t> is_met(n, 0);
    std::vector<std::uint32_t> order;
    for (const CellHandle c : mesh.cells())
        for (std::size_t i = 0; i < N; ++i)
            if (const std::uint32_t number = number_of(c, static_cast<int>(i)); is_met[number]++ == 0)
                order.push_back(number);
    return order;
}

std::vector<std::uint32_t> order_of(const TetMesh& mesh, EntityKind kind) {
    if (kind == EntityKind::edge)
        return order_by_cells<6>(mesh, mesh.n_edges(),
                                 [&](CellHandle c, int e) { return mesh.edge_handle(c, e).idx(); });
    if (kind == EntityKind::face)
        return order_by_cells<4>(mesh, mesh.n_faces(), [&](CellHandle c, int f) {
            return mesh.face_handle(TetMesh::halfface(c, f)).idx();
        });
    std::vector<std::uint32_t> order(kind == EntityKind::vertex ? mesh.n_vertices() : mesh.n_cells());
    std::iota(order.begin(), order.end(), 0U);
    return order;
}

/// Appends the property as a field if it has that type.
template <class T>
bool append_property(std::vector<Field>& fields, const BaseProperty& property, EntityKind kind,
                     FieldType type, const std::vector<std::uint32_t>& order) {
    const auto* typed = dynamic_cast<const Property<T>*>(&property);
    if (!typed) return false;
    Field field{property.name(), kind, type, {}};
    field.values.reserve(order.size() * field.n_components());
    for (std::uint32_t i : order) append(field.values, (*typed)[i]);
    // Functions of the user's cannot be kept; the reader chooses a rule.
    if (!property.has_own_rule()) field.rule = property.rule();
    if (typed->default_value() != initial_value<T>()) append(field.default_value, typed->default_value());
    fields.push_back(std::move(field));
    return true;
}

template <class T>
T value_at(const std::vector<double>& values, std::size_t i) {
    if constexpr (std::is_arithmetic_v<T>) {
        return static_cast<T>(values[i]);
    } else {
        return T(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
    }
}

std::size_t n_entities(const TetMesh& mesh, EntityKind kind) {
    switch (kind) {
        case EntityKind::vertex:
            return mesh.n_vertices();
        case EntityKind::edge:
            return mesh.n_edges();
        case EntityKind::face:
            return mesh.n_faces();
        case EntityKind::cell:
            return mesh.n_cells();
    }
    return 0;
}

template <class Entity, class T>
void add_field(TetMesh& mesh, const std::string& name, const Field& field) {
    const bool is_interpolated = field.kind == EntityKind::vertex && !std::is_integral_v<T>;
    const PropertyRule usual = is_interpolated ? PropertyRule::interpolate : PropertyRule::copy;
    T default_value = initial_value<T>();
    if (field.default_value.size() == field.n_components())
        default_value = value_at<T>(field.default_value, 0);
    const std::size_t n = n_entities(mesh, field.kind);
    if (field.values.size() != n * field.n_components())
        throw InputError(fmt::format("property '{}' has {} numbers for {} entities of {} each", name,
                                     field.values.size(), n, field.n_components()));
    PropertyHandle<Entity, T> handle;
    try {
        mesh.add_property(handle, name, PropertyHeritage<T>(field.rule.value_or(usual)), default_value);
    } catch (const std::invalid_argument& error) {
        throw InputError(error.what());
    }
    const auto view = mesh.property(handle);
    for (std::size_t i = 0; i < n; ++i)
        view[Entity(static_cast<TetMesh::Index>(i))] = value_at<T>(field.values, i);
}

template <class Entity>
void add_field(TetMesh& mesh, const std::string& name, const Field& field) {
    switch (field.type) {
        case FieldType::real64:
            return add_field<Entity, double>(mesh, name, field);
        case FieldType::real32:
            return add_field<Entity, float>(mesh, name, field);
        case FieldType::int32:
            return add_field<Entity, std::int32_t>(mesh, name, field);
        case FieldType::vector3:
            return add_field<Entity, Eigen::Vector3d>(mesh, name, field);
    }
}

template <class T>
bool append_value(std::vector<MeshValue>& values, const BaseProperty& property) {
    const auto* typed = dynamic_cast<const Property<T>*>(&property);
    if (typed) values.push_back({property.name(), (*typed)[0]});
    return typed != nullptr;
}

/// The name, with a number where it is taken.
template <class Key>
std::string free_name(std::set<std::pair<Key, std::string>>& taken, const Key& key,
                      const std::string& wanted) {
    std::string name = wanted;
    for (int i = 2; !taken.insert({key, name}).second; ++i) name = fmt::format("{} ({})", wanted, i);
    return name;
}

}  // namespace

const char* type_name(FieldType type) {
    switch (type) {
        case FieldType::real64:
            return "double";
        case FieldType::real32:
            return "float";
        case FieldType::int32:
            return "int32";
        case FieldType::vector3:
            return "vector3";
    }
    return "";
}

std::vector<Field> fields_of(const TetMesh& mesh, std::initializer_list<EntityKind> kinds) {
    std::vector<Field> fields;
    for (const EntityKind kind : kinds) {
        if (mesh.properties(kind).empty()) continue;
        const std::vector<std::uint32_t> order = order_of(mesh, kind);
        for (const auto& property : mesh.properties(kind).all()) {
            if (!property) continue;
            append_property<double>(fields, *property, kind, FieldType::real64, order) ||
                append_property<float>(fields, *property, kind, FieldType::real32, order) ||
                append_property<std::int32_t>(fields, *property, kind, FieldType::int32, order) ||
                append_property<Eigen::Vector3d>(fields, *property, kind, FieldType::vector3, order);
        }
    }
    return fields;
}

std::vector<MeshValue> mesh_values_of(const TetMesh& mesh) {
    std::vector<MeshValue> values;
    for (const auto& property : mesh.mesh_properties().all()) {
        if (!property) continue;
        append_value<std::string>(values, *property) || append_value<double>(values, *property) ||
            append_value<float>(values, *property) || append_value<std::int32_t>(values, *property) ||
            append_value<Eigen::Vector3d>(values, *property);
    }
    return values;
}

void add_fields(TetMesh& mesh, const std::vector<Field>& fields) {
    std::set<std::pair<EntityKind, std::string>> taken;
    for (const Field& field : fields) {
        const std::string name = free_name(taken, field.kind, field.name);
        switch (field.kind) {
            case EntityKind::vertex:
                add_field<VertexHandle>(mesh, name, field);
                break;
            case EntityKind::edge:
                add_field<EdgeHandle>(mesh, name, field);
                break;
            case EntityKind::face:
                add_field<FaceHandle>(mesh, name, field);
                break;
            case EntityKind::cell:
                add_field<CellHandle>(mesh, name, field);
                break;
        }
    }
}

void add_mesh_values(TetMesh& mesh, const std::vector<MeshValue>& values) {
    std::set<std::pair<int, std::string>> taken;
    for (const MeshValue& property : values)
        std::visit(
            [&]<class T>(const T& value) {
                MPropHandleT<T> handle;
                mesh.add_property(handle, free_name(taken, 0, property.name), value);
            },
            property.value);
}

void append_field(std::vector<Field>& fields, const std::string& name, EntityKind kind, FieldType scalar_type,
                  std::size_t n_components, std::vector<double> values) {
    if (n_components == 1) {
        fields.push_back({name, kind, scalar_type, std::move(values)});
    } else if (n_components == 3) {
        fields.push_back({name, kind, FieldType::vector3, std::move(values)});
    } else {
        for (std::size_t k = 0; k < n_components; ++k) {
            Field component{fmt::format("{}[{}]", name, k), kind, scalar_type, {}};
            for (std::size_t i = k; i < values.size(); i += n_components)
                component.values.push_back(values[i]);
            fields.push_back(std::move(component));
        }
    }
}

FieldType smallest_integer_type(const std::vector<double>& values) {
    using Limits = std::numeric_limits<std::int32_t>;
    const bool fits = std::ranges::all_of(
        values, [](double v) { return v == std::floor(v) && Limits::min() <= v && v <= Limits::max(); });
    return fits ? FieldType::int32 : FieldType::real64;
}

}  // namespace maille::volmesh::io
