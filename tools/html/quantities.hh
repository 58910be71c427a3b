#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "quality/report.hh"

namespace maille::html {

/// A number that every cell has, a measure or the estimated error, as the page shows it.
struct Quantity {
    std::string name, unit;
    double low, high;  ///< of the histogram; what is beyond is in its first and last bin
    double best;       ///< the value that a perfect cell has
    quality::Statistics statistics;
    std::vector<std::uint16_t> codes;  ///< by cell of the mesh

    std::uint32_t n_bins() const { return static_cast<std::uint32_t>(statistics.histogram.size()); }
};

/// Codes are whole numbers of 16 bits that keep a value's bin exactly, and its place within the bin as one of
/// `levels_of_bin` steps from end to end; the first and the last bin are stretched to the least and the
/// greatest value of all.
std::uint32_t levels_of_bin(const Quantity& quantity);
std::uint16_t encode(const Quantity& quantity, double value);
double decode(const Quantity& quantity, std::uint16_t code);

/// The measures that the report tells, and the error where there is one, with the codes of all cells. In
/// parallel. `size` and `errors` are those that the report was made with.
std::vector<Quantity> quantities_of(const volmesh::TetMesh& mesh, const quality::Report& report,
                                    const quality::WantedSize* size, std::span<const double> errors);

}  // namespace maille::html
