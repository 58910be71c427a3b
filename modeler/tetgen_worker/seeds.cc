#include "modeler/tetgen_worker/seeds.hh"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <vector>

#include <Eigen/Geometry>
#include <dlfcn.h>

#include "modeler/tetgen_worker/library.hh"

namespace maille::modeler::tetgen {
namespace {

const Request* waiting = nullptr;
bool have_told = false;

Eigen::Vector3d place_of(tetgenmesh::point p) {
    return {p[0], p[1], p[2]};
}

/// Tetrahedra that no facet separates.
struct Part {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< of the roundest one
    double roundness = 0;                              ///< of that
    std::map<int, double> areas{};                     ///< by region: that of the facets which say so
    bool is_open = false;                              ///< to the outside: TetGen takes it away unasked
    int region() const {
        return areas.empty() ? -1
                             : std::ranges::max_element(areas, {}, [](auto& a) { return a.second; })->first;
    }
};

/// Finds the parts of a mesh whose facets are recovered.
class PartFinder {
  public:
    PartFinder(tetgenmesh& mesh, const Request& request) : mesh_(mesh), request_(request) {}

    std::vector<Part> find() {
        std::vector<tetgenmesh::triface> all;
        mesh_.tetrahedrons->traversalinit();
        for (tetgenmesh::triface t; (t.tet = mesh_.tetrahedrontraverse()) != nullptr;) {
            if (mesh_.infected(t)) continue;
            parts_.emplace_back();
            flood(t, all);
        }
        for (auto& t : all) mesh_.uninfect(t);
        return std::move(parts_);
    }

  private:
    void flood(const tetgenmesh::triface& start, std::vector<tetgenmesh::triface>& all) {
        std::size_t i = all.size();
        all.push_back(start);
        mesh_.infect(all.back());
        for (; i < all.size(); ++i) {
            tetgenmesh::triface t = all[i];
            double area = 0;
            for (t.ver = 0; t.ver < 4; ++t.ver) area += look_across(t, all);
            t.ver = 0;
            offer(t, area);
        }
    }

    /// Goes on beyond the face, or hears the facet's word. Returns the face's area twice.
    double look_across(tetgenmesh::triface& t, std::vector<tetgenmesh::triface>& all) {
        const Eigen::Vector3d a = place_of(mesh_.dest(t)), b = place_of(mesh_.org(t)),
                              c = place_of(mesh_.apex(t));
        const Eigen::Vector3d outward = (b - a).cross(c - a);
        tetgenmesh::face facet;
        mesh_.tspivot(t, facet);
        if (facet.sh != nullptr) {
            const auto f = static_cast<std::size_t>(mesh_.shellmark(facet)) - 1;
            const auto& [i, j, k] = request_.facets.at(f);
            const std::vector<Eigen::Vector3d>& p = request_.points;
            const bool is_behind = outward.dot((p[j] - p[i]).cross(p[k] - p[i])) > 0;
            parts_.back().areas[request_.sides[f][is_behind ? 1 : 0]] += outward.norm();
        } else {
            tetgenmesh::triface next;
            mesh_.fsym(t, next);
            if (mesh_.ishulltet(next)) {
                parts_.back().is_open = true;
            } else if (!mesh_.infected(next)) {
                mesh_.infect(next);
                all.push_back(next);
            }
        }
        return outward.norm();
    }

    void offer(tetgenmesh::triface& t, double area) {
        const Eigen::Vector3d a = place_of(mesh_.org(t)), b = place_of(mesh_.dest(t)),
                              c = place_of(mesh_.apex(t)), d = place_of(mesh_.oppo(t));
        // Proportional to the inscribed sphere's radius.
        const double roundness = area > 0 ? std::abs((b - a).cross(c - a).dot(d - a)) / area : 0;
        if (Part& best = parts_.back(); roundness > best.roundness) {
            best.roundness = roundness;
            best.middle = (a + b + c + d) / 4;
        }
    }

    tetgenmesh& mesh_;
    const Request& request_;
    std::vector<Part> parts_;
};

void fill_seeds(tetgenmesh& mesh, const Request& request) {
    const std::vector<Part> parts = PartFinder(mesh, request).find();
    tetgenio& in = *mesh.in;
    in.regionlist = new double[5 * parts.size()];
    in.holelist = new double[3 * parts.size()];
    for (const Part& part : parts) {
        if (part.is_open) continue;
        const int region = part.region();
        double* place =
            region < 0 ? in.holelist + 3 * in.numberofholes++ : in.regionlist + 5 * in.numberofregions++;
        for (int k = 0; k < 3; ++k) *place++ = part.middle[k];
        if (region < 0) continue;
        *place++ = 0;
        *place = request.max_volumes.at(static_cast<std::size_t>(region));
    }
}

}  // namespace

void tell_regions(const Request& request) {
    waiting = &request;
}

bool have_told_regions() {
    return have_told;
}

}  // namespace maille::modeler::tetgen

// Stands before the library's own function of this name, which takes the seeds, and calls it.
void tetgenmesh::carveholes() {
    using namespace maille::modeler::tetgen;
    if (waiting != nullptr) fill_seeds(*this, *waiting);
    have_told = true;
    void* own = dlsym(RTLD_NEXT, "_ZN10tetgenmesh10carveholesEv");
    if (own == nullptr) {
        std::fprintf(stderr, "this TetGen library has no function of its own to carve holes\n");
        std::exit(2);
    }
    reinterpret_cast<void (*)(tetgenmesh*)>(own)(this);
}
