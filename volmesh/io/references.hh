#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "volmesh/io/combination_numbers.hh"
#include "volmesh/io/formats.hh"
#include "volmesh/io/mesh_draft.hh"
#include "volmesh/io/output_file.hh"

/// For formats in which an entity has one integer, its reference: it stands for the combination of sets that
/// the entity is in, 0 for none. A file beside, `<stem>.sets.json`, tells which references each set has.
namespace maille::volmesh::io {

class ReferenceWriter {
  public:
    ReferenceWriter(const TetMesh& mesh, const Path& mesh_path);

    int reference(EntityKind kind, CombinationId combination) {
        return combination == 0 ? 0 : numbers_[static_cast<std::size_t>(kind)].number(combination);
    }

    /// Writes the file beside; to be called when all references have been given out.
    void commit();

  private:
    const TetMesh& mesh_;
    OutputFile out_;
    std::array<CombinationNumbers, 4> numbers_;
};

/// Gathers members by reference.
class ReferenceReader {
  public:
    void add(EntityKind kind, long long reference, TetMesh::Index member) {
        if (reference != 0) members_[{kind, reference}].push_back(member);
    }

    /// Makes the draft's sets: with the names of the file beside if there is one; what it doesn't name is
    /// `group<reference>`. Throws InputError where that file is damaged or speaks of another mesh.
    void make_sets(MeshDraft& draft, const Path& mesh_path) const;

  private:
    std::map<std::pair<EntityKind, long long>, std::vector<TetMesh::Index>> members_;
};

}  // namespace maille::volmesh::io
