// ssbump/horizon/horizon.h - weights out of horizons: sweeps in some azimuths, exact integrals over the
// elevations.
#pragma once

#include "ssbump/generate_options.h"
#include "ssbump/horizon/horizon_sums.h"
#include "ssbump/map/weights.h"

#include <cstdint>
#include <functional>

namespace rnmbake {

/// For each texel of the rows wanted: sums over both grids and those of another set of azimuths, sines, and
/// the weights. Beside them all heights are kept once more.
inline constexpr std::size_t horizon_bytes_per_texel =
    4 * SsbumpWeights::channels * sizeof(float) + 2 * HorizonSines::azimuths * sizeof(std::uint16_t);

/// Weights of rows first_row .. last_row - 1; the field's other rows cast shadows on them, too.
[[nodiscard]] SsbumpWeights horizon_rows(const HeightField& field, const GenerateOptions& options,
                                         int first_row, int last_row,
                                         const std::function<void(double)>& progress,
                                         const std::function<bool()>& stop);

}  // namespace rnmbake
