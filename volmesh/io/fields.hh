#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh::io {

enum class FieldType : std::uint8_t { real64, real32, int32, vector3 };

/// Values of a property of vertices or cells, as doubles, which hold each of the types exactly.
struct Field {
    std::string name;
    EntityKind kind;
    FieldType type;
    std::vector<double> values;  ///< component by component

    std::size_t n_components() const { return type == FieldType::vector3 ? 3 : 1; }
};

/// "double", "float", "int32", "vector3".
const char* type_name(FieldType type);

/// The properties of vertices and cells that files can hold, in the order of their making.
std::vector<Field> fields_of(const TetMesh& mesh);

/// Makes the properties: real ones at vertices interpolate, others are copied. A name that is taken gets a
/// number.
void add_fields(TetMesh& mesh, const std::vector<Field>& fields);

/// Adds what a file has as one array: a vector where there are three components, else one field each, which
/// has the component's number in its name where there are several.
void append_field(std::vector<Field>& fields, const std::string& name, EntityKind kind, FieldType scalar_type,
                  std::size_t n_components, std::vector<double> values);

/// A field of integers if all values are, and fit; else of doubles.
FieldType smallest_integer_type(const std::vector<double>& values);

}  // namespace maille::volmesh::io
