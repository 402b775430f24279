// pipeline/ssbump/ssbump_run.h - `rnmbake ssbump` from a height map: read, filter, generate, write.
#pragma once

#include "base/progress.h"
#include "ssbump/directions/direction_rows.h"
#include "ssbump/generate/generate.h"
#include "ssbump/heights/read_heights.h"
#include "ssbump/map/files.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rnmbake {

struct SsbumpRunOptions {
  std::filesystem::path input;
  HeightOptions heights;
  int filter_radius = 10;             // 0: the heights as they are
  std::optional<double> filter_edge;  // in the file's values; none given: 3 % of their range
  GenerateOptions generate;           // its albedo_map is filled in
  /// Computes the weights in place of `generate`; may be empty. Called once.
  std::function<SsbumpWeights(const HeightField&)> baked;
  /// A map of a set of directions (ssbump/map/direction_map.h), by rays, in place of all that.
  std::optional<DirectionOptions> directions;
  std::filesystem::path albedo;  // a colour texture of the map's size; may be empty
  bool modulate = true;          // whether the albedo's luminance multiplies the weights
  SsbumpOutput output;
  std::filesystem::path normal, dump_height;  // may be empty
};

struct SsbumpRunSummary {
  ReadHeights heights;  // without the field's texels
  int width = 0, height = 0;
  double edge = 0;                  // that the filter used, in the file's values
  int azimuths = 0;                 // of the horizon; 0: another method
  double rmse = -1;                 // as estimated where they were chosen; else below 0
  std::vector<WeightRange> ranges;  // right, upper left, lower left, up, ambient; or of each direction
  std::vector<std::pair<std::string, double>> seconds;  // of read, filter, generate (with encoding), in order
};

/// All files are in place at the end, or none is. Throws Error as its parts do, Interrupted after a signal.
SsbumpRunSummary run_ssbump(const SsbumpRunOptions& options, Progress& progress);

}  // namespace rnmbake
