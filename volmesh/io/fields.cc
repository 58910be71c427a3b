#include "volmesh/io/fields.hh"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/core.h>

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

/// Appends the property as a field if it has that type.
template <class T>
bool append_property(std::vector<Field>& fields, const BaseProperty& property, EntityKind kind,
                     FieldType type) {
    const auto* typed = dynamic_cast<const Property<T>*>(&property);
    if (!typed) return false;
    Field field{property.name(), kind, type, {}};
    field.values.reserve(typed->size() * field.n_components());
    for (const T& value : typed->values()) append(field.values, value);
    fields.push_back(std::move(field));
    return true;
}

template <class Entity, class T>
void add_field(TetMesh& mesh, const std::string& name, const Field& field) {
    const bool is_interpolated = field.kind == EntityKind::vertex && !std::is_integral_v<T>;
    PropertyHandle<Entity, T> handle;
    mesh.add_property(handle, name,
                      PropertyHeritage<T>(is_interpolated ? PropertyRule::interpolate : PropertyRule::copy),
                      T());
    const auto view = mesh.property(handle);
    const std::size_t n = field.values.size() / field.n_components();
    for (std::size_t i = 0; i < n; ++i) {
        T& value = view[Entity(static_cast<TetMesh::Index>(i))];
        if constexpr (std::is_arithmetic_v<T>) {
            value = static_cast<T>(field.values[i]);
        } else {
            value = T(field.values[3 * i], field.values[3 * i + 1], field.values[3 * i + 2]);
        }
    }
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

std::vector<Field> fields_of(const TetMesh& mesh) {
    std::vector<Field> fields;
    for (const EntityKind kind : {EntityKind::vertex, EntityKind::cell}) {
        for (const auto& property : mesh.properties(kind).all()) {
            if (!property) continue;
            append_property<double>(fields, *property, kind, FieldType::real64) ||
                append_property<float>(fields, *property, kind, FieldType::real32) ||
                append_property<std::int32_t>(fields, *property, kind, FieldType::int32) ||
                append_property<Eigen::Vector3d>(fields, *property, kind, FieldType::vector3);
        }
    }
    return fields;
}

void add_fields(TetMesh& mesh, const std::vector<Field>& fields) {
    std::set<std::pair<EntityKind, std::string>> taken;
    for (const Field& field : fields) {
        std::string name = field.name;
        for (int i = 2; !taken.insert({field.kind, name}).second; ++i)
            name = fmt::format("{} ({})", field.name, i);
        if (field.kind == EntityKind::vertex) {
            add_field<VertexHandle>(mesh, name, field);
        } else {
            add_field<CellHandle>(mesh, name, field);
        }
    }
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
