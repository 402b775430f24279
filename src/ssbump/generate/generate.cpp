#include "ssbump/generate/generate.h"

#include "base/error.h"
#include "base/machine.h"
#include "ssbump/generate/generate_bounces.h"
#include "ssbump/generate/generate_rays.h"
#include "ssbump/horizon/horizon.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <tbb/task_arena.h>

namespace rnmbake {
namespace {

constexpr int least_rows = 16;

void check(const HeightField& field, const GenerateOptions& options) {
  if (field.heights.empty())
    fail(ExitCode::invalid_input, "the height map is empty: give one of at least 1 x 1 texels");
  if (field.heights.channels() != 1)
    fail(ExitCode::invalid_input, "the height map has {} channels: choose one of them",
         field.heights.channels());
  if (!std::ranges::all_of(field.heights.data(), [](float h) { return std::abs(h) < 1e9F; }))
    fail(ExitCode::invalid_input,
         "the height map has values that are not finite (or past 1e9 texels): mend them first");
  if (options.azimuths < 0 || options.near_rows < 0 || options.rays < 1)
    fail(ExitCode::usage, "azimuths and near rows must be at least 0, rays at least 1");
  if (!(options.error > 0)) fail(ExitCode::usage, "the error must be above 0");
  const FloatImage* albedo = options.albedo_map;
  if (albedo != nullptr && (albedo->width() != field.width() || albedo->height() != field.height()))
    fail(ExitCode::invalid_input,
         "the albedo map is {} x {}, the height map {} x {}: give one of the same size", albedo->width(),
         albedo->height(), field.width(), field.height());
  if (!(options.power > 0)) fail(ExitCode::usage, "the power must be above 0");
}

SsbumpWeights some_rows(const HeightField& field, const GenerateOptions& options, int first_row, int last_row,
                        const std::function<void(double)>& progress, const std::function<bool()>& stop) {
  SsbumpWeights weights = options.method == SsbumpMethod::horizon
                              ? horizon_rows(field, options, first_row, last_row, progress, stop)
                              : rays_rows(field, options, first_row, last_row, progress, stop);
  if (options.bounces > 0 && options.method != SsbumpMethod::cone)
    add_bounces(field, options, first_row, weights, stop);
  return weights;
}

/// Rows at once within the memory limit.
int rows_at_once(const HeightField& field, const GenerateOptions& options) {
  const std::uint64_t memory =
      options.memory > 0 ? options.memory : std::max(usable_memory() / 4, std::uint64_t{2} << 30);
  const std::uint64_t fixed = field.heights.texels() * sizeof(float);  // the grid's
  const std::uint64_t left = memory > fixed ? memory - fixed : 0;
  const std::uint64_t row = horizon_bytes_per_texel * static_cast<std::uint64_t>(field.width());
  const std::uint64_t fit = std::max(left / row, std::uint64_t{least_rows});
  return static_cast<int>(std::min(fit, static_cast<std::uint64_t>(field.height())));
}

}  // namespace

SsbumpWeights generate(const HeightField& field, const GenerateOptions& options,
                       const std::function<void(double)>& progress, const std::function<bool()>& stop) {
  check(field, options);
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  return arena.execute([&] { return some_rows(field, options, 0, field.height(), progress, stop); });
}

void generate_rows(const HeightField& field, const GenerateOptions& options,
                   const std::function<void(int first_row, const SsbumpWeights& rows)>& done,
                   const std::function<void(double)>& progress, const std::function<bool()>& stop) {
  check(field, options);
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  const int height = field.height(), rows = rows_at_once(field, options);
  const int bands = (height + rows - 1) / rows;
  for (int band = 0; band < bands; ++band) {
    const auto from = static_cast<int>(std::int64_t{height} * band / bands);
    const auto to = static_cast<int>(std::int64_t{height} * (band + 1) / bands);
    std::function<void(double)> say;
    if (progress) say = [&](double share) { progress((band + share) / bands); };
    const SsbumpWeights part = arena.execute([&] { return some_rows(field, options, from, to, say, stop); });
    if (stop && stop()) return;
    done(from, part);
  }
}

}  // namespace rnmbake
