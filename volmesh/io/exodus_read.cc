#if __has_include(<exodusII.h>)

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <map>
#include <span>
#include <sstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "volmesh/error.hh"
#include "volmesh/io/exodus_library.hh"
#include "volmesh/io/formats.hh"
#include "volmesh/io/input_file.hh"
#include "volmesh/io/mesh_draft.hh"
#include "volmesh/io/netcdf_header.hh"
#include "volmesh/io/rule_text.hh"

namespace maille::volmesh::io {

namespace {

using Index = TetMesh::Index;
using Numbers = std::vector<std::int64_t>;

class ExodusReader {
  public:
    explicit ExodusReader(const Path& path);

    MeshDraft read();

  private:
    [[noreturn]] void fail(const std::string& message) const {
        throw InputError(fmt::format("{}: {}", path_.string(), message));
    }
    void check(int status, const char* what) const {
        if (status < 0) fail(fmt::format("{} cannot be read: Exodus' library gave error {}", what, status));
    }
    /// A count that the file can hold, at so many bytes each.
    std::size_t checked(std::int64_t n, std::size_t bytes_each, const char* what) const;
    /// An array for n values, with the room that the library may take.
    template <class T>
    std::vector<T> array(std::size_t n) const {
        return std::vector<T>(std::max(n, room_) + 1);
    }
    Numbers ids(ex_entity_type type, std::size_t n, const char* what) const;
    std::string name(ex_entity_type type, std::int64_t id) const;
    std::vector<std::string> information() const;
    bool has_mark() const { return std::ranges::find(information_, exodus_mark) != information_.end(); }
    void read_rules();
    void read_points();
    template <std::size_t N>
    void read_block(ex_entity_type type, std::int64_t id, std::vector<std::array<Index, N>>& elements);
    void read_cells();
    void read_edges();
    void read_sets(ex_entity_type type, EntityKind kind, std::int64_t n_sets);
    void add_members(MeshDraft::Set& set, std::span<const std::int64_t> entries,
                     std::span<const std::int64_t> extras);
    void put_cells_in_order();

    Path path_;
    const ExodusLibrary& library_;
    std::size_t bytes_ = 0;
    std::size_t room_ = 0;  ///< what the longest variable takes: the library fills as much of any array
    ExodusFile file_;
    ex_init_params sizes_{};
    std::vector<std::string> information_;
    /// By kind and number.
    std::map<std::pair<EntityKind, std::int64_t>, std::string> set_names_;
    MeshDraft draft_;
};

ExodusReader::ExodusReader(const Path& path) : path_(path), library_(exodus_library()) {
    // The library takes any file for NetCDF's or HDF5's; see that it is one.
    const InputFile file(path);
    const std::string_view head = file.text().substr(0, 4);
    if (!head.starts_with("CDF") && head != "\x89HDF") fail("is no Exodus file: neither NetCDF nor HDF5");
    if (head.starts_with("CDF")) room_ = check_netcdf_header(file).longest_variable;
    constexpr std::size_t best_ratio = 1000;  // of HDF5's compression
    bytes_ = head.starts_with("CDF") ? file.text().size() : best_ratio * file.text().size();
    int word = sizeof(double);
    int stored_word = 0;
    float version = 0;
    file_ =
        ExodusFile(library_.open(path.c_str(), EX_READ, &word, &stored_word, &version, EX_API_VERS_NODOT));
    check(file_, "the file");
    library_.set_int64_status(file_, EX_ALL_INT64_API);
    const auto longest = library_.inquire_int(file_, EX_INQ_DB_MAX_USED_NAME_LENGTH);
    library_.set_max_name_length(file_, static_cast<int>(std::clamp<std::int64_t>(longest, 32, 255)));
    check(library_.get_init(file_, &sizes_), "its sizes");
    if (sizes_.num_dim != 3) fail("its dimension should be 3");
}

std::size_t ExodusReader::checked(std::int64_t n, std::size_t bytes_each, const char* what) const {
    if (n < 0 || static_cast<std::size_t>(n) > bytes_ / bytes_each)
        fail(fmt::format("{} is said to be {}, more than the file can hold", what, n));
    return static_cast<std::size_t>(n);
}

Numbers ExodusReader::ids(ex_entity_type type, std::size_t n, const char* what) const {
    auto all = array<std::int64_t>(n);
    if (n > 0) check(library_.get_ids(file_, type, all.data()), what);
    all.resize(n);
    return all;
}

std::string ExodusReader::name(ex_entity_type type, std::int64_t id) const {
    std::array<char, longest_exodus_text + 1> text{};
    if (library_.get_name(file_, type, id, text.data()) < 0 || text[0] == '\0') return group_name(id);
    return text.data();
}

std::vector<std::string> ExodusReader::information() const {
    const auto n = library_.inquire_int(file_, EX_INQ_INFO);
    if (n <= 0) return {};
    std::vector<std::array<char, MAX_LINE_LENGTH + 1>> lines(
        checked(n, 1, "the number of lines of information"));
    std::vector<char*> places;
    for (auto& line : lines) places.push_back(line.data());
    if (library_.get_info(file_, places.data()) < 0) return {};
    return {places.begin(), places.end()};
}

void ExodusReader::read_rules() {
    std::map<std::pair<EntityKind, std::int64_t>, std::string> rules;
    for (const std::string& line : information_) {
        if (!line.starts_with(exodus_rule_mark)) continue;
        std::istringstream words(line.substr(exodus_rule_mark.size()));
        std::string kind;
        std::int64_t number = 0;
        std::string piece;
        words >> kind >> number;
        words.get();
        std::getline(words, piece);
        rules[{parse_kind(kind), number}] += piece.substr(0, piece.rfind('|'));
    }
    for (const auto& [of, rule] : rules)
        if (const auto name = set_names_.find(of); name != set_names_.end())
            draft_.set(name->second, of.first).rule = parse_set_rule(rule, of.first);
}

void ExodusReader::read_points() {
    const std::size_t n = checked(sizes_.num_nodes, 12, "the number of nodes");
    std::array<std::vector<double>, 3> x{array<double>(n), array<double>(n), array<double>(n)};
    if (n > 0) check(library_.get_coord(file_, x[0].data(), x[1].data(), x[2].data()), "coordinates");
    for (std::size_t i = 0; i < n; ++i) {
        const Point& p = draft_.points.emplace_back(x[0][i], x[1][i], x[2][i]);
        if (!p.allFinite()) fail(fmt::format("a coordinate of node {} is not a finite number", i + 1));
    }
}

template <std::size_t N>
void ExodusReader::read_block(ex_entity_type type, std::int64_t id,
                              std::vector<std::array<Index, N>>& elements) {
    std::array<char, longest_exodus_text + 1> shape{};
    std::int64_t n_entries = 0;
    std::int64_t n_nodes = 0;
    std::int64_t n_edges = 0;
    std::int64_t n_faces = 0;
    std::int64_t n_attributes = 0;
    check(library_.get_block(file_, type, id, shape.data(), &n_entries, &n_nodes, &n_edges, &n_faces,
                             &n_attributes),
          "a block");
    if (n_entries == 0) return;
    if (n_nodes != static_cast<std::int64_t>(N))
        fail(fmt::format(
            "block {} has elements '{}' of {} nodes, which cannot be read: only linear tetrahedra can", id,
            shape.data(), n_nodes));
    if (N == 4 && !std::string_view(shape.data()).starts_with("TET") &&
        !std::string_view(shape.data()).starts_with("tet"))
        fail(fmt::format("block {} has elements '{}', which cannot be read: only tetrahedra can", id,
                         shape.data()));
    const std::size_t n = checked(n_entries, 4 * N, "the number of a block's elements");
    auto nodes = array<std::int64_t>(N * n);
    check(library_.get_conn(file_, type, id, nodes.data(), nullptr, nullptr),
          "the nodes of a block's elements");
    for (std::size_t i = 0; i < n; ++i) {
        auto& element = elements.emplace_back();
        for (std::size_t k = 0; k < N; ++k) {
            const std::int64_t node = nodes[N * i + k];
            if (node < 1 || node > static_cast<std::int64_t>(draft_.points.size()))
                fail(fmt::format("an element of block {} has node {}, which there is not", id, node));
            element[k] = static_cast<Index>(node - 1);
        }
    }
}

void ExodusReader::read_cells() {
    const bool are_blocks_sets = !has_mark();
    const std::size_t n_blocks = checked(sizes_.num_elem_blk, 4, "the number of blocks");
    for (std::int64_t id : ids(EX_ELEM_BLOCK, n_blocks, "the blocks")) {
        const auto first = static_cast<Index>(draft_.cells.size());
        read_block(EX_ELEM_BLOCK, id, draft_.cells);
        if (!are_blocks_sets) continue;
        auto& members = draft_.set(name(EX_ELEM_BLOCK, id), EntityKind::cell).members;
        for (Index c = first; c < draft_.cells.size(); ++c) members.push_back(c);
    }
    if (static_cast<std::int64_t>(draft_.cells.size()) != sizes_.num_elem)
        fail(fmt::format("has {} elements in its blocks, not {}", draft_.cells.size(), sizes_.num_elem));
}

/// Those of one block, by their number in the file.
void ExodusReader::read_edges() {
    const std::size_t n_blocks = checked(sizes_.num_edge_blk, 4, "the number of blocks of edges");
    for (std::int64_t id : ids(EX_EDGE_BLOCK, n_blocks, "the blocks of edges"))
        read_block(EX_EDGE_BLOCK, id, draft_.edges);
}

void ExodusReader::add_members(MeshDraft::Set& set, std::span<const std::int64_t> entries,
                               std::span<const std::int64_t> extras) {
    const std::size_t n = set.kind == EntityKind::vertex ? draft_.points.size()
                          : set.kind == EntityKind::edge ? draft_.edges.size()
                                                         : draft_.cells.size();
    for (std::size_t i = 0; i < entries.size(); ++i) {
        if (entries[i] < 1 || entries[i] > static_cast<std::int64_t>(n))
            fail(fmt::format("set '{}' has a member {}, which there is not", set.name, entries[i]));
        const auto entry = static_cast<Index>(entries[i] - 1);
        if (set.kind != EntityKind::face) {
            set.members.push_back(entry);
            continue;
        }
        const auto side = std::ranges::find(exodus_side, extras[i]);
        if (side == std::end(exodus_side))
            fail(fmt::format("set '{}' has side {} of a tetrahedron", set.name, extras[i]));
        std::array<Index, 3> face{};
        for (int k = 0; k < 3; ++k)
            face[k] = draft_.cells[entry][tet::face_vertices[side - std::begin(exodus_side)][k]];
        set.members.push_back(static_cast<Index>(draft_.faces.size()));
        draft_.faces.push_back(face);
    }
}

void ExodusReader::read_sets(ex_entity_type type, EntityKind kind, std::int64_t n_sets) {
    auto entries = array<std::int64_t>(0);
    auto extras = array<std::int64_t>(0);
    for (std::int64_t id : ids(type, checked(n_sets, 4, "the number of sets"), "the sets")) {
        std::int64_t n_said = 0;
        std::int64_t n_factors = 0;
        check(library_.get_set_param(file_, type, id, &n_said, &n_factors), "the size of a set");
        const std::size_t n = checked(n_said, 4, "the number of a set's members");
        const bool has_extras = kind == EntityKind::face || kind == EntityKind::edge;
        entries.resize(std::max(entries.size(), n));
        extras.resize(std::max(extras.size(), n));
        if (n > 0)
            check(library_.get_set(file_, type, id, entries.data(), has_extras ? extras.data() : nullptr),
                  "a set");
        const std::string& of_set = set_names_[{kind, id}] = name(type, id);
        add_members(draft_.set(of_set, kind), std::span(entries).first(n), std::span(extras).first(n));
    }
}

/// Where we wrote the file, cells have the numbers that they had in the mesh.
void ExodusReader::put_cells_in_order() {
    const std::size_t n = draft_.cells.size();
    if (n == 0 || !has_mark()) return;
    auto numbers = array<std::int64_t>(n);
    check(library_.get_id_map(file_, EX_ELEM_MAP, numbers.data()), "the numbers of elements");
    numbers.resize(n);
    std::vector<std::uint8_t> is_there(n, 0);
    for (std::int64_t number : numbers)
        if (number < 1 || number > static_cast<std::int64_t>(n) || is_there[number - 1]++ != 0)
            fail("its elements should be numbered from 1 on, each once");
    auto cells = draft_.cells;
    for (std::size_t i = 0; i < n; ++i) cells[numbers[i] - 1] = draft_.cells[i];
    draft_.cells = std::move(cells);
    for (MeshDraft::Set& set : draft_.sets)
        if (set.kind == EntityKind::cell)
            for (Index& member : set.members) member = static_cast<Index>(numbers[member] - 1);
}

MeshDraft ExodusReader::read() {
    information_ = information();
    read_points();
    read_cells();
    read_edges();
    read_sets(EX_ELEM_SET, EntityKind::cell, sizes_.num_elem_sets);
    read_sets(EX_SIDE_SET, EntityKind::face, sizes_.num_side_sets);
    read_sets(EX_EDGE_SET, EntityKind::edge, sizes_.num_edge_sets);
    read_sets(EX_NODE_SET, EntityKind::vertex, sizes_.num_node_sets);
    put_cells_in_order();
    try {
        read_rules();
    } catch (const InputError& error) {
        fail(error.what());
    }
    return std::move(draft_);
}

/// Far more than any sound file takes.
void limit_processor_time(std::uintmax_t file_bytes) {
    const rlim_t seconds = 20 + file_bytes / 1'000'000;
    const rlimit limit{seconds, seconds};
    ::setrlimit(RLIMIT_CPU, &limit);
}

/// The libraries of Exodus and HDF5 may crash on a damaged file, or never end. So another process reads it
/// first: what that one survives, this one does, which reads the same.
void read_in_another_process(const Path& path) {
    const std::uintmax_t file_bytes = std::filesystem::file_size(path);
    const pid_t child = ::fork();
    if (child < 0)
        throw InputError(fmt::format("{}: cannot be read: {}", path.string(), std::strerror(errno)));
    if (child == 0) {
        for (int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) std::signal(signal, SIG_DFL);
        limit_processor_time(file_bytes);
        if (const int nowhere = ::open("/dev/null", O_WRONLY); nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
        try {
            ExodusReader(path).read();
        } catch (const std::exception&) {  // for the other process to meet and tell
        }
        ::_exit(0);
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw InputError(path.string() +
                         ": cannot be read: it is damaged, so that the library of Exodus fails");
}

}  // namespace

TetMesh read_exodus(const Path& path) {
    read_in_another_process(path);
    return assemble(ExodusReader(path).read(), path);
}

}  // namespace maille::volmesh::io

#else

#include "volmesh/error.hh"
#include "volmesh/io/formats.hh"

namespace maille::volmesh::io {

TetMesh read_exodus(const Path& path) {
    throw InputError(path.string() +
                     ": Exodus files cannot be read: this program was built without their library");
}

void write_exodus(const TetMesh&, const Path& path) {
    throw InputError(path.string() +
                     ": Exodus files cannot be written: this program was built without their library");
}

}  // namespace maille::volmesh::io

#endif
