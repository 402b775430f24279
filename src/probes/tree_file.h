// probes/tree_file.h - trees of light probes as pictures.
#pragma once

#include "image/layered_exr.h"
#include "probes/probe_tree.h"

#include <cstddef>

namespace rnmbake {

/// Columns of a picture with so many texels, as many as rows or one more.
[[nodiscard]] int square_width(std::size_t texels);
/// Rows.
[[nodiscard]] int square_height(std::size_t texels);

/// The layer "cell": one texel for each cell, row by row, then 0: numbers of its corners' probes in c0 to c7,
/// and in `children` that of its first cell, or 0. All are whole, and exact in floats.
[[nodiscard]] LayeredImage tree_picture(const ProbeTree& tree);

/// The same back; check_tree() is up to the caller. Throws Error(invalid_input) where numbers are none.
[[nodiscard]] ProbeTree tree_of(const LayeredImage& image, std::size_t cells);

}  // namespace rnmbake
