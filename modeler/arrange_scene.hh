#pragma once

#include <array>
#include <cstdint>
#include <exception>
#include <new>
#include <span>
#include <string>
#include <vector>

#include "modeler/arrange.hh"
#include "modeler/arrange_registry.hh"

namespace maille::modeler::detail {

/// What is to be arranged: facets that may cross and overlap. As the surface of a solid, each facet raises
/// the winding number of its `back` by one on its back side and that of its `front` on its front side.
using Scene = Arrangement;

/// The triangles of all primitives, each with its primitive behind it.
Scene gather(std::span<const ClosedSurface> primitives);

/// Makes points nearer than `distance` one (the earliest of them) and drops the facets that vanish by it.
void weld(Scene& scene, double distance);

/// Diagonal of the box of all points.
double diagonal(const FacetComplex& complex);

/// The distance below which places count as one: `relative` to the diagonal, but not finer than what the
/// coordinates can tell apart.
double tolerance(const FacetComplex& complex, double relative);

/// Throws an ArrangeError that names the primitives of the facets and the place of the first of them.
[[noreturn]] void fail(const FacetComplex& complex, std::span<const std::uint32_t> facets,
                       const std::string& problem);

/// The same, with an ArrangeLimitError.
[[noreturn]] void fail_for_work(const FacetComplex& complex, std::span<const std::uint32_t> facets);

/// Calls f. Where it comes upon something that must not happen, it fails at the facets.
template <class F>
auto guarded(const FacetComplex& complex, std::span<const std::uint32_t> facets, const F& f) {
    try {
        return f();
    } catch (const InputError&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const RegistryFull&) {
        fail_for_work(complex, facets);
    } catch (const std::exception& error) {
        fail(complex, facets, std::string("cannot be cut where they meet: ") + error.what());
    }
}

/// The key of an edge, whichever way it runs.
constexpr std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
    return a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
}

}  // namespace maille::modeler::detail
