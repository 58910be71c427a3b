// Sections of Gmsh's format 2.2. An element that is in several physical groups is there once for each of
// them.
#include <algorithm>
#include <array>
#include <set>

#include <fmt/core.h>

#include "volmesh/io/msh_contents.hh"

namespace maille::volmesh::io::msh {

namespace {

struct Tags {
    std::int32_t group = 0;  ///< 0: none
    std::int32_t entity = 0;
};

/// One element's tags: the group, the entity, and partitions.
Tags read_tags(MshSource& source, std::int32_t n_tags) {
    Tags tags;
    for (std::int32_t i = 0; i < n_tags; ++i) {
        const std::int32_t tag = source.integer("a tag of an element");
        if (i == 0) tags.group = tag;
        if (i == 1) tags.entity = tag;
    }
    return tags;
}

/// Tetrahedra that stand there once for each of their groups are made one again. Only an entity whose
/// elements have several groups can have such.
class RepeatedCells {
  public:
    void add(Tags tags) {
        tags_.push_back(tags);
        groups_of_entity_[tags.entity].insert(tags.group);
    }

    void merge(Contents& contents) const {
        const auto is_suspect = [](const auto& entry) { return entry.second.size() > 1; };
        if (std::ranges::none_of(groups_of_entity_, is_suspect)) return;
        auto& cells = contents.draft.cells;
        std::vector<Index> place(cells.size());
        std::map<std::array<Index, 4>, Index> first_of;
        Index n_kept = 0;
        for (Index i = 0; i < cells.size(); ++i) {
            place[i] = n_kept;
            if (groups_of_entity_.at(tags_[i].entity).size() > 1) {
                auto key = cells[i];
                std::ranges::sort(key);
                place[i] = first_of.try_emplace(key, n_kept).first->second;
            }
            if (place[i] == n_kept) cells[n_kept++] = cells[i];
        }
        cells.resize(n_kept);
        contents.cells.redirect(place);
        for (auto& [group, members] : contents.members)
            if (group.dimension == 3)
                for (Index& member : members) member = place[member];
    }

  private:
    std::vector<Tags> tags_;
    std::map<std::int32_t, std::set<std::int32_t>> groups_of_entity_;
};

void read_element(Contents& contents, MshSource& source, std::int32_t type, std::uint64_t number,
                  std::int32_t n_tags, RepeatedCells& repeated) {
    const Tags tags = read_tags(source, n_tags);
    const int n_vertices = n_nodes(source, type);
    std::array<std::uint64_t, 5> numbers{number};
    for (int k = 1; k <= n_vertices; ++k)
        numbers[k] = static_cast<std::uint64_t>(source.integer("a node of an element"));
    std::span<const std::int32_t> groups(&tags.group, tags.group == 0 ? 0 : 1);
    if (const auto listed = contents.groups_of_entity.find({n_vertices - 1, tags.entity});
        listed != contents.groups_of_entity.end())
        groups = listed->second;
    add_elements(contents, source, type, std::span(numbers).first(1 + n_vertices), groups);
    if (type == tetrahedron) repeated.add(tags);
}

}  // namespace

void read_nodes22(Contents& contents, MshSource& source) {
    const std::size_t n = source.text().count("the number of nodes", 8);
    source.text().line();
    contents.draft.points.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        contents.nodes.push_back(static_cast<std::uint64_t>(source.integer("the number of a node")));
        contents.draft.points.push_back(source.point());
    }
    sort_nodes(contents, source);
}

void read_elements22(Contents& contents, MshSource& source) {
    const std::size_t n = source.text().count("the number of elements", 8);
    source.text().line();
    RepeatedCells repeated;
    for (std::size_t i = 0; i < n;) {
        // Text has one element a line, binary several with one head.
        std::int32_t number = source.is_binary() ? 0 : source.integer("the number of an element");
        const std::int32_t type = source.integer("a type of element");
        const std::int32_t n_here =
            source.is_binary() ? source.integer("the number of elements that follow") : 1;
        const std::int32_t n_tags = source.integer("the number of tags");
        if (n_here < 1 || n_tags < 0) source.fail("a number of elements or tags is below its least");
        for (std::int32_t k = 0; k < n_here; ++k) {
            if (source.is_binary()) number = source.integer("the number of an element");
            read_element(contents, source, type, static_cast<std::uint64_t>(number), n_tags, repeated);
        }
        i += static_cast<std::size_t>(n_here);
    }
    repeated.merge(contents);
    contents.cells.sort();
}

}  // namespace maille::volmesh::io::msh
