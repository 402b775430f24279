// bake/plan.h - receiver passes, tasks, and batches: one batch for each launch of Blender.
#pragma once

#include "bake/atlas.h"
#include "bake/fences.h"
#include "bake/glow.h"
#include "bake/receiver.h"
#include "bake/targets.h"
#include "config/bake_settings.h"
#include "scene/survey.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

/// Cycles settings that all tasks of a launch share.
struct CyclesSettings {
  int samples = 256, bounces = 32, seed = 0;
  double clamp = 0;
  std::string device = "CPU";
  bool lamps = true;     // whether lamp objects give light
  double noise = 0;      // relative standard error that is enough, a share; 0: `samples` decide
  bool mirrors = false;  // receivers are mirrors; what they meet at once does not count (bake/mirrors.h)
  bool operator==(const CyclesSettings&) const = default;
};

/// What gets pictures of its own: a target with a lightmap (bake/targets.h), or a block of points in free
/// space (bake/point_receivers.h).
struct PlanTarget {
  std::string key;           // in messages
  RectSize map;              // texels
  std::string light_group;   // of its object (scene/survey.h); "" in free space
  std::string content = {};  // what decides its pictures and is not in the plan's rectangles, as a hash
};
[[nodiscard]] PlanTarget plan_target(const SceneSurvey& survey, const Target& target);

/// A receiver pass cropped to the texels that it covers. Texel rows count from the bottom.
struct AtlasRect {
  std::size_t target = 0;
  ReceiverPass pass;
  int x = 0, y = 0;  // lower left texel within the target's map
  RectSize size;
};

/// One basis of one target: the smallest unit that can be baked and retried. The moments, which all bases
/// share, are a task of their own.
struct BakeTask {
  std::size_t target = 0;
  std::string name;                // "basis flat", "horizon": what messages call it
  std::size_t basis = 0;           // index into the bases
  std::vector<std::size_t> rects;  // indices into Plan::rects
  CyclesSettings cycles;
};

/// One launch of Blender.
struct Batch {
  std::vector<std::size_t> tasks;
};

/// What keeps light that comes from below a face from the receivers on it.
struct FaceGuards {
  std::vector<std::vector<Fence>> fences;  // [targets], or none at all
  GlowHeights glow_heights;                // of all targets
};

struct Plan {
  std::vector<PlanTarget> targets;
  std::vector<AtlasRect> rects;
  std::optional<FaceGuards> guards;  // absent: receivers stand in free space
  std::vector<BakeTask> tasks;
  std::vector<Batch> batches;
  std::vector<std::string> absent;  // keys of objects that are not there (scene/survey.h)
};

/// Names of the tasks of each basis: "basis flat", ...
[[nodiscard]] std::vector<std::string> task_names(const std::vector<BasisDirection>& bases);

/// Adds a target and, cropped, its passes as tasks, one for each of `names`. Passes without a triangle are
/// left out, and so are triangles between the centres of texels (bake/texel_centres.h).
void add_receiver_tasks(Plan& plan, PlanTarget target, ReceiverPasses passes,
                        const std::vector<std::string>& names, const CyclesSettings& cycles);

/// Adds a target with tasks without receivers, for flat-normal-map: Blender bakes the object itself. One
/// rectangle each, the whole lightmap.
void add_object_tasks(Plan& plan, PlanTarget target, const std::vector<std::string>& names,
                      const CyclesSettings& cycles);

/// Groups tasks into batches: one for each task, each target, or all that share their Cycles settings.
void group_tasks(Plan& plan, BakingSettings::Dispatch mode);

/// Resolves `automatic`: joined for receivers, a launch for each object otherwise.
[[nodiscard]] BakingSettings::Dispatch resolve_dispatch(const BakingSettings& settings);

/// Texels of some of the plan's rectangles, which the time and the memory of a bake are proportional to.
[[nodiscard]] std::int64_t texels_of(const Plan& plan, const std::vector<std::size_t>& rects);

/// Batches of whole targets, in their order, none of which has more pixels than `max_pixels`, unless a single
/// target has.
[[nodiscard]] std::vector<Batch> cut(const Batch& batch, const Plan& plan, std::int64_t max_pixels);

/// The two halves of a batch that failed; at a boundary between targets where there is one.
[[nodiscard]] std::vector<Batch> split(const Batch& batch, const Plan& plan);

/// Bytes that Blender's peak grows by with one pixel of an atlas, one triangle of the scene and one triangle
/// of a receiver, whose corners share nothing (measured, docs/performance.md; rounded up).
inline constexpr std::int64_t bytes_per_pixel = 240;
inline constexpr std::int64_t bytes_per_scene_triangle = 500;
inline constexpr std::int64_t bytes_per_receiver_triangle = 1600;

/// The largest atlas (pixels) that a memory limit (bytes) allows beside the scene itself; at least one
/// megapixel.
[[nodiscard]] std::int64_t atlas_pixels(std::int64_t atlas_limit, std::int64_t memory,
                                        std::int64_t scene_triangles, std::int64_t receiver_triangles);

}  // namespace rnmbake
