// Sections of Gmsh's format 4.1, as its manual (section "MSH file format") has them.
#include <algorithm>
#include <array>

#include <fmt/core.h>

#include "volmesh/io/msh_contents.hh"

namespace maille::volmesh::io::msh {

namespace {

std::vector<std::int32_t> read_tags(MshSource& source, const char* what) {
    std::vector<std::int32_t> tags(source.count(what, 1));
    for (std::int32_t& tag : tags) tag = source.integer("a tag");
    return tags;
}

/// The entities of all dimensions; those of a partition name their parents too.
void read_entity_lists(Contents& contents, MshSource& source, bool is_partitioned) {
    std::array<std::size_t, 4> counts{};
    for (std::size_t& n : counts) n = source.count("the number of entities", 4);
    for (int dimension = 0; dimension < 4; ++dimension) {
        for (std::size_t i = 0; i < counts[dimension]; ++i) {
            const std::int32_t tag = source.integer("the tag of an entity");
            if (is_partitioned) {
                source.integer("the dimension of a parent");
                source.integer("the tag of a parent");
                read_tags(source, "the number of partitions");
            }
            for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) source.real("a bound");
            contents.groups_of_entity[{dimension, tag}] = read_tags(source, "the number of physical groups");
            if (dimension > 0) read_tags(source, "the number of bounding entities");
        }
    }
}

}  // namespace

void read_entities(Contents& contents, MshSource& source) {
    read_entity_lists(contents, source, false);
}

void read_partitioned_entities(Contents& contents, MshSource& source) {
    source.size("the number of partitions");
    const std::size_t n_ghosts = source.count("the number of ghost entities", 2);
    for (std::size_t i = 0; i < n_ghosts; ++i) {
        source.integer("the tag of a ghost entity");
        source.integer("the partition of a ghost entity");
    }
    read_entity_lists(contents, source, true);
}

void read_nodes41(Contents& contents, MshSource& source) {
    const std::size_t n_blocks = source.count("the number of node blocks", 4);
    for (const char* what : {"the number of nodes", "the lowest node", "the highest node"}) source.size(what);
    for (std::size_t block = 0; block < n_blocks; ++block) {
        const std::int32_t dimension = source.integer("the dimension of an entity");
        source.integer("the tag of an entity");
        const bool is_parametric = source.integer("0 or 1 for parametric nodes") != 0;
        const std::size_t n = source.count("the number of nodes", 4);
        contents.draft.points.reserve(contents.draft.points.size() + n);
        for (std::size_t i = 0; i < n; ++i) contents.nodes.push_back(source.size("the number of a node"));
        for (std::size_t i = 0; i < n; ++i) {
            contents.draft.points.push_back(source.point());
            if (is_parametric)
                for (int k = 0; k < dimension; ++k) source.real("a parameter");
        }
    }
    sort_nodes(contents, source);
}

void read_elements41(Contents& contents, MshSource& source) {
    const std::size_t n_blocks = source.count("the number of element blocks", 4);
    // A tetrahedron takes five numbers of at least a digit and a blank.
    contents.draft.cells.reserve(std::min<std::size_t>(
        source.size("the number of elements"), source.text().n_left() / (source.is_binary() ? 40 : 10)));
    for (const char* what : {"the lowest element", "the highest element"}) source.size(what);
    for (std::size_t block = 0; block < n_blocks; ++block) {
        const std::int32_t dimension = source.integer("the dimension of an entity");
        const std::int32_t entity = source.integer("the tag of an entity");
        const std::int32_t type = source.integer("a type of element");
        const int n_vertices = n_nodes(source, type);
        const std::size_t n = source.count("the number of elements", 1 + n_vertices);
        const auto groups = contents.groups_of_entity.find({dimension, entity});
        const std::span<const std::int32_t> of_block =
            groups == contents.groups_of_entity.end() ? std::span<const std::int32_t>() : groups->second;
        constexpr std::size_t batch = 1024;
        std::vector<std::uint64_t> numbers;
        for (std::size_t done = 0; done < n; done += batch) {
            numbers.resize(std::min(batch, n - done) * (1 + n_vertices));
            source.sizes(numbers, "the number of an element or of its node");
            add_elements(contents, source, type, numbers, of_block);
        }
    }
    contents.cells.sort();
}

}  // namespace maille::volmesh::io::msh
