#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh::io {

enum class FieldType : std::uint8_t { real64, real32, int32, vector3 };

/// Values of a property as doubles, which hold each of the types exactly. Edges and faces are in the order in
/// which one comes to them cell by cell, by local number; as a mesh that has just been read numbers them.
struct Field {
    std::string name;
    EntityKind kind;
    FieldType type;
    std::vector<double> values;  ///< component by component
    std::optional<PropertyRule> rule{};
    std::vector<double> default_value{};  ///< component by component; none where it isn't told

    std::size_t n_components() const { return type == FieldType::vector3 ? 3 : 1; }
};

/// A property of the whole mesh: a text, or numbers of one of the types.
struct MeshValue {
    std::string name;
    std::variant<std::string, double, float, std::int32_t, Eigen::Vector3d> value;
};

/// "double", "float", "int32", "vector3".
const char* type_name(FieldType type);

/// The properties of these kinds that files can hold, kind by kind in the order of their making.
std::vector<Field> fields_of(const TetMesh& mesh, std::initializer_list<EntityKind> kinds = {
                                                      EntityKind::vertex, EntityKind::cell});
std::vector<MeshValue> mesh_values_of(const TetMesh& mesh);

/// Makes the properties, with the rules that the fields tell; where they tell none real ones at vertices
/// interpolate and others are copied. A name that is taken gets a number. Throws InputError where there are
/// too few or too many values, or a rule does not suit.
void add_fields(TetMesh& mesh, const std::vector<Field>& fields);
void add_mesh_values(TetMesh& mesh, const std::vector<MeshValue>& values);

/// Adds what a file has as one array: a vector where there are three components, else one field each, which
/// has the component's number in its name where there are several.
void append_field(std::vector<Field>& fields, const std::string& name, EntityKind kind, FieldType scalar_type,
                  std::size_t n_components, std::vector<double> values);

/// A field of integers if all values are, and fit; else of doubles.
FieldType smallest_integer_type(const std::vector<double>& values);

}  // namespace maille::volmesh::io
