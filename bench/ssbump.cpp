// bench/ssbump.cpp - time and error of a sweep for self-shadowed bump maps, beside a loop of Embree's rays
// over the same heights.
//
// Prints one JSON object. Times are the best of some runs where one is short.
#include "base/clock.h"
#include "cobbles.h"
#include "ray_loop.h"
#include "sampled_weights.h"
#include "ssbump/generate/generate.h"
#include "ssbump/heights/bilateral.h"
#include "ssbump/horizon/horizon_sweep.h"

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <functional>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <tbb/task_arena.h>

namespace rnmbake {
namespace {

using nlohmann::json;

constexpr int run_count = 7;
constexpr float range = 32, edge_share = 0.03F;  // heights; of them, as in the command
constexpr int azimuths_of_sides = 64;
constexpr int margin = 256;  // past which rays of the loop meet nothing
constexpr int part = 16;     // of the loop's rows are traced to choose how to go on
constexpr std::uint64_t seed_of_loop = 1, seed_of_truth = 2;
constexpr int azimuths_of_truth = 2048;

struct Arguments {
  int side = 1024, threads = 2, rays = 256, samples = 200, truth_rays = 65536;
  double patience = 30;
  std::vector<int> sides{512, 1024, 2048, 4096, 8192};
};

/// Seconds of wall clock and of all threads' processor time; other work on the machine adds to the former
/// alone.
struct Time {
  double seconds = 0, cpu_seconds = 0;
};

void to_json(json& to, const Time& time) {
  to = {{"seconds", time.seconds}, {"cpu_seconds", time.cpu_seconds}};
}

Time time_of(const std::function<void()>& work) {
  const double start = steady_clock().now();
  const std::clock_t cpu_start = std::clock();
  work();
  return {steady_clock().now() - start, double(std::clock() - cpu_start) / CLOCKS_PER_SEC};
}

/// Each clock's best; once if that takes longer than `enough` seconds.
Time best_of(int runs, const std::function<void()>& work, double enough = 2) {
  Time best = time_of(work);
  for (int i = 1; i < runs && best.seconds < enough; ++i) {
    const Time time = time_of(work);
    best = {std::min(best.seconds, time.seconds), std::min(best.cpu_seconds, time.cpu_seconds)};
  }
  return best;
}

/// Over the three axes and straight up; ambient occlusion is the latter again.
json errors(const std::vector<Channels>& found, const std::vector<Channels>& truth) {
  const WeightErrors all = errors_of(found, truth, SsbumpWeights::ambient);
  return {{"rmse", all.rmse}, {"max", all.largest}};
}

struct Truths {
  std::vector<Texel> samples;
  std::vector<Channels> by_rays, by_horizons;
};

Truths truths_of(const HeightField& field, const Arguments& arguments) {
  const std::vector<Texel> samples = spread_texels(arguments.side, arguments.side, arguments.samples);
  const HemisphereRays rays(arguments.truth_rays, 1, seed_of_truth);
  return {samples, by_rays(field, samples, rays.set(0)), by_horizons(field, samples, azimuths_of_truth)};
}

json measure_sweep(const HeightField& field, const Truths& truths, GenerateOptions options) {
  SsbumpWeights weights;
  json result{{"time", best_of(run_count, [&] { weights = generate(field, options); })}};
  result["azimuths"] = weights.azimuths;
  const std::vector<Channels> found = picked(weights, truths.samples);
  result["error"] = errors(found, truths.by_rays);
  result["error_to_horizons"] = errors(found, truths.by_horizons);
  return result;
}

json measure_instructions(const HeightField& field, const GenerateOptions& options) {
  json result = json::object();
  const std::vector<std::string> all = sweep_instructions();
  for (const std::string& name : all) {
    use_sweep_instructions(name);
    result[name] = best_of(run_count, [&] { static_cast<void>(generate(field, options)); });
  }
  use_sweep_instructions(all.front());
  return result;
}

json measure_sides(const Arguments& arguments, GenerateOptions options) {
  options.azimuths = azimuths_of_sides;  // the same for all
  json rows = json::array();
  for (const int side : arguments.sides) {
    const HeightField field = cobbles(side, range);
    const Time time =
        best_of(run_count, [&] { generate_rows(field, options, [](int, const SsbumpWeights&) {}); });
    rows.push_back({{"side", side}, {"time", time}});
  }
  return rows;
}

json measure_filter(const HeightField& field, int threads) {
  const BilateralOptions options{.edge = edge_share * range, .threads = threads};
  const Time time = best_of(run_count, [&] { static_cast<void>(bilateral(field, options)); });
  return {{"radius", options.radius}, {"time", time}};
}

/// The loop over some of the rows of squares, `step` apart, as if over all of them.
Time time_loop(const RayLoop& loop, const HemisphereRays& rays, RayLoop::Packet packet, int step,
               SsbumpWeights& weights) {
  int rows = 0;
  const Time time = time_of([&] {
    for (int row = step / 2; row < loop.tile_rows(); row += step, ++rows)
      loop.trace_row(row, rays, packet, weights);
  });
  const double share = double(loop.tile_rows()) / rows;
  return {share * time.seconds, share * time.cpu_seconds};
}

json measure_loop(const HeightField& field, const Truths& truths, const Arguments& arguments) {
  const double start = steady_clock().now();
  const RayLoop loop(field, margin);
  json result{{"rays", arguments.rays}, {"build_seconds", steady_clock().now() - start}};
  const HemisphereRays rays(arguments.rays, 1, seed_of_loop);
  SsbumpWeights weights{FloatImage(field.width(), field.height(), SsbumpWeights::channels)};

  const int step = std::min(part, loop.tile_rows());
  const Time ones = time_loop(loop, rays, RayLoop::Packet::one, step, weights);
  const Time eights = time_loop(loop, rays, RayLoop::Packet::eight, step, weights);
  const bool single = ones.cpu_seconds < eights.cpu_seconds;
  const RayLoop::Packet packet = single ? RayLoop::Packet::one : RayLoop::Packet::eight;
  const Time expected = single ? ones : eights;
  const bool whole = expected.seconds <= arguments.patience;
  result["by_ones"] = ones;
  result["by_eights"] = eights;
  result["packet"] = single ? 1 : 8;
  result["whole"] = whole;
  result["time"] = whole ? time_loop(loop, rays, packet, 1, weights) : expected;

  if (!whole) {  // samples lie in any row
    for (const Texel& texel : truths.samples) loop.trace_square(texel.x, texel.y, rays, packet, weights);
  }
  const HemisphereRays many(arguments.truth_rays, 1, seed_of_truth);
  const auto own =
      for_each(truths.samples, [&](Texel texel) { return loop.texel(texel.x, texel.y, many.set(0)); });
  const std::vector<Channels> found = picked(weights, truths.samples);
  result["error"] = errors(found, truths.by_rays);
  result["error_of_own_surface"] = errors(found, own);
  result["surfaces_differ"] = errors(own, truths.by_rays);
  return result;
}

json measure(const Arguments& arguments) {
  GenerateOptions options;
  options.threads = arguments.threads;
  const HeightField field = cobbles(arguments.side, range);
  const Truths truths = truths_of(field, arguments);
  json result{{"side", arguments.side},
              {"threads", arguments.threads},
              {"samples", arguments.samples},
              {"truth_rays", arguments.truth_rays},
              {"truths_differ", errors(truths.by_rays, truths.by_horizons)}};
  result["sweep"] = measure_sweep(field, truths, options);
  result["loop"] = measure_loop(field, truths, arguments);
  result["instructions"] = measure_instructions(field, options);
  result["filter"] = measure_filter(field, arguments.threads);
  result["sides"] = measure_sides(arguments, options);
  return result;
}

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Times self-shadowed bump maps of heights");
  app.add_option("--side", arguments.side, "of the map that the methods are compared on");
  app.add_option("--sides", arguments.sides, "of maps that the sweep is timed on");
  app.add_option("--threads", arguments.threads);
  app.add_option("--rays", arguments.rays, "of the loop, for each texel");
  app.add_option("--samples", arguments.samples, "texels whose truth is known");
  app.add_option("--truth-rays", arguments.truth_rays);
  app.add_option("--patience", arguments.patience, "seconds; a loop that takes longer is extrapolated");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error));
  }
  return arguments;
}

}  // namespace
}  // namespace rnmbake

int main(int argc, char** argv) {
  const rnmbake::Arguments arguments = rnmbake::parse(argc, argv);
  tbb::task_arena arena(arguments.threads);
  arena.execute([&] { std::cout << rnmbake::measure(arguments).dump(2) << '\n'; });
}
