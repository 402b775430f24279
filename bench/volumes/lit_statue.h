// bench/volumes/lit_statue.h - a statue in the light of probes, held against what arrives at its surface.
#pragma once

#include "probes/place_probes.h"
#include "trace/gather_options.h"

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

struct StatueStudy {
  std::filesystem::path scene;    // .rnmscene
  std::string statue = "statue";  // its key
  std::vector<Vec3d> places;      // that it is moved to, one after the other; world space
  ProbeBounds bounds;
  std::vector<double> spacings;  // between probes, units
  DirectLight direct;            // that probes hold, and truth
  bool black = false;            // the statue sends no light to itself, nor to anything
  int points = 1500;             // on the statue, evenly over its area
  int samples = 256;             // of a point in each of eight batches, and of a probe's hemisphere
};

/// Errors over all points that light of anything but the statue reaches, "rmse" and "bias" in shares of the
/// mean light at each place ("means", E/pi), so that dark places count as bright ones do; noise taken out,
/// and what it may still add or take ("square_error": one standard error of the square of "rmse").
/// Against three truths: "own", light without the statue's own shadow, which probes know nothing of; "seen",
/// with it; "occluded", with it, where what is looked up is multiplied by the statue's ambient occlusion.
/// "rows": one for each spacing, leak test and encoding, and with a spacing of 0 "own" of probes at the very
/// points; "floor": of exact light without the shadow, in place
/// of probes. Throws Error(invalid_input) where the scene has no such statue.
[[nodiscard]] nlohmann::json study_statue(const StatueStudy& study);

}  // namespace rnmbake
