// report/comparison.h - results of a comparison, as plain data for the writers.
#pragma once

#include "image/float_image.h"
#include "image/metrics.h"

#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace rnmbake {

struct BasisMetrics {
  std::string name;  // "flat", "rnm0", ...
  PictureMetrics metrics;
};

/// Textures of one basis to look at, all of one size: scaled down by report/maps.h, not for measuring. Texels
/// that do not count are NaN. Missing maps are empty.
struct BasisMaps {
  std::string basis;
  FloatImage candidate, reference;              // RGB, E/pi
  FloatImage candidate_noise, reference_noise;  // one channel: standard error
};

struct ObjectComparison {
  std::string key;
  std::vector<std::string> candidate_files, reference_files;
  int width = 0, height = 0;  // of the lightmap, before anything was scaled down
  double coverage = 0;        // share of the map's texels that are covered on both sides
  double validity =
      std::numeric_limits<double>::quiet_NaN();  // share of these that are sound; NaN: not known
  std::vector<BasisMetrics> bases;
  std::vector<BasisMaps> maps;
  std::vector<std::string> notes;
  std::vector<std::string> outside_model;  // what the reference cannot trace here ("glossy", ...)
};

/// One cause of error: its share of the candidate's bias, and its RMSE.
struct DecompositionRow {
  std::string name;      // "tilt clamp", "bump shadowing", "self-reflection", "light from below", ...
  Statistic bias, rmse;  // E/pi
  Statistic relative_bias, relative_rmse;  // to the reference's mean
};

struct BasisDecomposition {
  std::string basis;
  double reference_mean = 0;
  std::vector<DecompositionRow> rows;  // causes in order, then "noise" and "residual"
  DecompositionRow total;              // candidate minus reference
};

struct Decomposition {
  std::string subject;  // an object's key, or "scene"
  std::vector<BasisDecomposition> bases;
};

struct StudyPoint {
  std::string name;  // "whole", "material", "loose", "grid 2", ...
  std::size_t targets = 0;
  double seconds = 0;
  Statistic error;  // RMSE relative to the reference's mean
};

/// Error and time against the number of bake targets.
struct SplitStudy {
  std::vector<StudyPoint> points;
};

struct ViewPicture {
  std::string label;   // "Cycles", "single lightmap", "RNM, squared", ...
  FloatImage picture;  // RGB, linear
  bool has_error = false;
  double rmse = 0, relative_rmse = 0, bias = 0, relative_bias = 0;  // against the view's first picture
  int bytes = 0;  // of a texel of the lightmaps, or of a probe, that it is lit by; 0: by none
  bool by_probes = false;
};

/// One camera's view, rendered in several ways; the first picture is what the others are compared with.
struct ViewComparison {
  std::string name;
  std::vector<ViewPicture> pictures;
};

/// One limit of --fail-above, and what it met.
struct Threshold {
  std::string metric;  // "rmse", "bias", "p95", "p99", "max"
  double limit = 0;
  bool relative = false;  // `limit` is a share of the reference's mean, else E/pi
};
struct Exceeded {
  std::string object, basis;
  Threshold threshold;
  double value = 0;  // in the threshold's own terms
};
struct ThresholdOutcome {
  std::vector<Threshold> thresholds;  // none: nothing was asked
  std::vector<Exceeded> exceeded;
};

using KeyValues = std::vector<std::pair<std::string, std::string>>;

/// Light that is lost beyond the number of bounces that a bake follows.
struct BounceLimit {
  int bounces = -1;         // -1: not measured, for it cannot matter
  Statistic relative_bias;  // mean over the bases, to the reference's mean
};

struct Report {
  std::string title;
  std::string candidate_label = "candidate", reference_label = "reference";
  std::string finding;  // one sentence; empty: report/finding.h writes it from the numbers
  KeyValues settings, versions;
  std::string command;  // that makes this report again
  std::vector<ObjectComparison> objects;
  std::vector<BasisMetrics> scene;                          // all objects as one, texel by texel
  std::vector<std::string> candidate_only, reference_only;  // keys of objects without a partner
  std::vector<std::string> notes;
  std::vector<std::string> not_followed;  // by the reference, though the candidate has it
  BounceLimit bounce_limit;
  std::vector<Decomposition> decompositions;
  SplitStudy study;
  std::vector<ViewComparison> views;
  ThresholdOutcome thresholds;
};

}  // namespace rnmbake
