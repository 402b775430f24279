// bake/request.h - a dispatch as blender_scripts/bake_entry.py wants it, and its pictures back.
#pragma once

#include "bake/atlas.h"
#include "bake/plan.h"
#include "bake/sample_passes.h"
#include "bake/targets.h"
#include "image/float_image.h"
#include "scene/survey.h"

#include <filesystem>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

/// Placement of each atlas rectangle of a batch: picture and texel.
struct BatchLayout {
  std::vector<std::size_t> rects;  // indices into Plan::rects
  AtlasPlan atlas;                 // placements in the order of `rects`
};

/// What lightmaps are baked of, with their plan.
struct BakeContext {
  const SceneSurvey& survey;
  const std::vector<Target>& targets;
  const std::vector<BasisDirection>& bases;
  const Plan& plan;
};

struct BakeRequest {
  nlohmann::json json;  // without its passes
  BatchLayout layout;
};

/// A pass as bake_entry.py wants it; `number`: of the pass within its batch.
[[nodiscard]] nlohmann::json pass_request(const SamplePass& pass, std::size_t number,
                                          const BatchLayout& layout, int seed);

/// Receivers of all tasks, joined over atlases of at most `max_pixels`. Writes the arrays (32-bit floats:
/// positions, normals, UVs of each group of corners) into `folder`.
[[nodiscard]] BakeRequest receiver_request(const Plan& plan, const Batch& batch, std::int64_t max_pixels,
                                           const std::filesystem::path& folder);

/// The published recipe: objects with their own materials. Writes unwrapped UVs and part lists into `folder`.
[[nodiscard]] BakeRequest object_request(const BakeContext& context, const Batch& batch, bool correct_bump,
                                         const std::filesystem::path& folder);

[[nodiscard]] nlohmann::json to_json(const CyclesSettings& settings);

/// Files of a pass's pictures, one for each atlas; each appears when it is whole.
[[nodiscard]] std::vector<std::string> pass_files(std::size_t number, const BatchLayout& layout);

/// The rectangles (RGBA, row 0 on top, in the order of layout.rects) of a finished pass.
/// Throws Error(tasks_failed) where a file is missing, or not as long as its picture.
[[nodiscard]] std::vector<FloatImage> read_rects(const BatchLayout& layout, const Plan& plan,
                                                 const std::filesystem::path& folder, std::size_t number = 0);

}  // namespace rnmbake
