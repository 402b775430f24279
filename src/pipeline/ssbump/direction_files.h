// pipeline/ssbump/direction_files.h - the weights of a set of directions into their file, some rows at a
// time.
#pragma once

#include "image/picture_rows.h"
#include "ssbump/directions/direction_rows.h"
#include "ssbump/map/weight_ranges.h"

#include <functional>
#include <vector>

namespace rnmbake {

/// Writes all rows; the caller commits. Returns the range of each direction's weights. `progress` receives
/// the share that is done; once `stop` says true the file is unfinished.
[[nodiscard]] std::vector<WeightRange> write_directions(const HeightField& field,
                                                        const DirectionOptions& options,
                                                        PictureWriter& writer,
                                                        const std::function<void(double)>& progress,
                                                        const std::function<bool()>& stop);

}  // namespace rnmbake
