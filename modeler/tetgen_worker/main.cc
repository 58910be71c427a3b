// maille-tetgen: runs TetGen once, in a process of its own. TetGen has global state, so that it cannot run
// twice at once in a process, and on many errors it crashes or hangs.
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <vector>

#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "modeler/tetgen_protocol.hh"
#include "modeler/tetgen_worker/library.hh"
#include "modeler/tetgen_worker/seeds.hh"

namespace {

using namespace maille::modeler::tetgen;

std::vector<char> read_all(int descriptor) {
    std::vector<char> bytes;
    std::array<char, 1 << 16> buffer{};
    for (;;) {
        const ssize_t n = read(descriptor, buffer.data(), buffer.size());
        if (n < 0) {
            std::perror("maille-tetgen: reading the request");
            std::exit(2);
        }
        if (n == 0) return bytes;
        bytes.insert(bytes.end(), buffer.data(), buffer.data() + n);
    }
}

void write_all(int descriptor, std::span<const char> bytes) {
    while (!bytes.empty()) {
        const ssize_t n = write(descriptor, bytes.data(), bytes.size());
        if (n < 0) {
            std::perror("maille-tetgen: writing the answer");
            std::exit(2);
        }
        bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
}

void fill(tetgenio& in, const Request& request) {
    in.firstnumber = 0;
    in.numberofpoints = static_cast<int>(request.points.size());
    in.pointlist = new double[3 * request.points.size()];
    double* coordinate = in.pointlist;
    for (const Eigen::Vector3d& p : request.points)
        for (int k = 0; k < 3; ++k) *coordinate++ = p[k];

    in.numberoffacets = static_cast<int>(request.facets.size());
    in.facetlist = new tetgenio::facet[request.facets.size()];
    in.facetmarkerlist = new int[request.facets.size()];
    for (std::size_t f = 0; f < request.facets.size(); ++f) {
        tetgenio::facet& facet = in.facetlist[f];
        tetgenio::init(&facet);
        facet.numberofpolygons = 1;
        facet.polygonlist = new tetgenio::polygon[1];
        tetgenio::init(facet.polygonlist);
        facet.polygonlist->numberofvertices = 3;
        facet.polygonlist->vertexlist = new int[3];
        for (int k = 0; k < 3; ++k) facet.polygonlist->vertexlist[k] = static_cast<int>(request.facets[f][k]);
        in.facetmarkerlist[f] = static_cast<int>(f) + 1;
    }
}

Answer answer_from(const tetgenio& out) {
    Answer answer;
    for (int i = 0; i < out.numberofpoints; ++i)
        answer.points.emplace_back(out.pointlist[3 * i], out.pointlist[3 * i + 1], out.pointlist[3 * i + 2]);
    for (int t = 0; t < out.numberoftetrahedra; ++t) {
        std::array<std::uint32_t, 4> cell{}, neighbors{};
        for (int k = 0; k < 4; ++k) {
            cell[k] = static_cast<std::uint32_t>(out.tetrahedronlist[4 * t + k]);
            neighbors[k] = static_cast<std::uint32_t>(out.neighborlist[4 * t + k]);
        }
        answer.cells.push_back(cell);
        answer.neighbors.push_back(neighbors);
    }
    for (int f = 0; f < out.numberoftrifaces; ++f) {
        if (out.trifacemarkerlist[f] <= 0) continue;
        std::array<std::uint32_t, 3> facet{};
        for (int k = 0; k < 3; ++k) facet[k] = static_cast<std::uint32_t>(out.trifacelist[3 * f + k]);
        answer.facets.push_back(facet);
        answer.parents.push_back(static_cast<std::uint32_t>(out.trifacemarkerlist[f]) - 1);
    }
    return answer;
}

void limit_processor_time(double seconds) {
    const auto limit = static_cast<rlim_t>(seconds) + 1;
    const rlimit both{limit, limit};
    setrlimit(RLIMIT_CPU, &both);
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
}

}  // namespace

int main() {
    prctl(PR_SET_PDEATHSIG, SIGKILL);          // no worker outlives the program that asked
    std::setvbuf(stdout, nullptr, _IONBF, 0);  // what TetGen prints has to survive its crash
    const std::vector<char> bytes = read_all(STDIN_FILENO);
    Request request;
    Unpacker unpacker(bytes);
    visit_request(unpacker, request);
    limit_processor_time(request.processor_time);

    static tetgenio in, out;
    fill(in, request);
    if (!request.sides.empty()) tell_regions(request);
    tetrahedralize(request.switches.data(), &in, &out);
    if (!request.sides.empty() && !have_told_regions()) {
        std::fprintf(stderr, "this TetGen library did not ask for its regions\n");
        std::exit(2);
    }

    Packer packer;
    const Answer answer = answer_from(out);
    visit_answer(packer, answer);
    write_all(answer_descriptor, packer.bytes);
    _exit(0);
}
