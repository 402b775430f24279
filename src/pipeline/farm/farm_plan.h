// pipeline/farm/farm_plan.h - a bake as tasks that any machine may run: what a plan folder holds.
//
// plan.json, which every task reads, tasks/ (what became of each), batches/ (what to bake, read by the
// batch's tasks alone), scene/ (scenes that were made for it); docs/farm.md has the format.
#pragma once

#include "bake/sample_passes.h"
#include "config/resolve.h"
#include "jobs/key.h"
#include "jobs/run_record.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

struct FarmPass {
  SamplePass samples;
  ResultKey key;       // under which its result lies in the cache
  double seconds = 0;  // predicted
};

struct FarmBatch {
  std::vector<std::string> objects;  // keys of its targets
  std::vector<FarmPass> passes;      // of a plan in the making; read_passes() has those of one that was read
};

/// Passes [first, first + count) of a batch: one launch.
struct FarmShare {
  std::size_t batch = 0, first = 0, count = 0;
};

struct FarmTask {
  std::vector<FarmShare> shares;
  double seconds = 0;  // predicted, with the start of Blender
};

/// What the nodes' Blender must be.
struct FarmBlender {
  std::string version, build, scripts;  // the last: hash
};

struct FarmPlan {
  std::filesystem::path folder;  // absolute
  std::string id;                // of this plan, so that results of an earlier one are not taken for its own
  FarmBlender blender;
  std::filesystem::path scene;  // .blend that launches open, absolute
  ResultKey scene_key;
  std::int64_t scene_triangles = 0;
  int jobs = 1;                       // Blenders at a time that atlases were laid out for
  nlohmann::json settings;            // key -> value, of those that launches need
  std::filesystem::path output;       // of the lightmaps, absolute
  std::filesystem::path work_folder;  // in which `merge` was typed
  std::vector<std::string> merge;     // arguments of the bake that merges
  std::vector<RunFile> inputs;        // files that the scene reads, as they were
  std::vector<FarmBatch> batches;
  std::vector<FarmTask> tasks;

  [[nodiscard]] std::filesystem::path batch_folder(std::size_t batch) const;
  /// Of an entry in the cache that shows a node that it looks into the same one.
  [[nodiscard]] ResultKey probe_key() const;
};

/// Passes of batches, and at last plan.json.
void write_farm_plan(const FarmPlan& plan);

/// Of a plan folder, or an output folder with one in its usual place. Throws Error(io) where there is none,
/// Error(invalid_input) where it cannot be understood.
[[nodiscard]] FarmPlan read_farm_plan(const std::filesystem::path& folder);

/// Passes of the batches that a task has shares of. Throws Error(invalid_input) where a share names others.
using PassesByBatch = std::map<std::size_t, std::vector<FarmPass>>;
[[nodiscard]] PassesByBatch read_passes(const FarmPlan& plan, const FarmTask& task);

/// The usual place of a plan: within the output folder.
[[nodiscard]] std::filesystem::path usual_plan_folder(const std::filesystem::path& output);

/// What a node changes of the plan's settings; empty and 0: as planned.
struct NodeSettings {
  std::string blender;
  int threads = 0;
  bool keep_temporary = false;
  bool must_see_output = false;  // where the merge may run here, too
};

/// The settings of a launch on a node.
[[nodiscard]] ResolvedConfig node_config(const FarmPlan& plan, const NodeSettings& node);

/// Settings that launches need, for FarmPlan::settings; paths absolute.
[[nodiscard]] nlohmann::json launch_settings(const ResolvedConfig& config);

}  // namespace rnmbake
