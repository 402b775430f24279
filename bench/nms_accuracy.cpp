// Normal mapping shadows against the exact shadows of the same heights: the tables of
// docs/normal-mapping-shadows.md, which bench/nms_accuracy.py puts there.
//
//   bench_nms --heightmaps ../shared/heightmaps
#include "base/error.h"
#include "nms_surfaces.h"
#include "ssbump/heights/height_shadows.h"
#include "ssbump/map/slope_curl.h"
#include "ssbump/normal_shadows/normal_shadows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace rnmbake {
namespace {

constexpr int azimuths = 5;
constexpr std::array elevations{15.0, 30.0, 45.0, 60.0};

/// Sums over texels that face the light.
struct Score {
  double count = 0, shadowed = 0, right = 0, found = 0, wrongly = 0;
  double soft = 0, soft2 = 0, truth = 0, truth_soft = 0;
  double error_soft = 0, error_hard = 0, error_none = 0;

  void add(double lit, bool seen, double soft_left, bool hard_seen) {
    count += 1;
    if (!seen) shadowed += 1;
    if (seen == hard_seen) right += 1;
    if (!seen && !hard_seen) found += 1;
    if (seen && !hard_seen) wrongly += 1;
    const double true_left = seen ? 1 : 0;
    soft += soft_left;
    soft2 += soft_left * soft_left;
    truth += true_left;
    truth_soft += true_left * soft_left;
    const auto squared = [&](double left) { return lit * lit * (left - true_left) * (left - true_left); };
    error_soft += squared(soft_left);
    error_hard += squared(hard_seen ? 1 : 0);
    error_none += squared(1);
  }
  Score& operator+=(const Score& other) {
    for (auto member : {&Score::count, &Score::shadowed, &Score::right, &Score::found, &Score::wrongly,
                        &Score::soft, &Score::soft2, &Score::truth, &Score::truth_soft, &Score::error_soft,
                        &Score::error_hard, &Score::error_none})
      this->*member += other.*member;
    return *this;
  }
  [[nodiscard]] double correlation() const {
    const double between = truth_soft / count - soft / count * (truth / count);
    const double spread =
        (soft2 / count - soft / count * (soft / count)) * (truth / count - truth / count * (truth / count));
    return spread > 0 ? between / std::sqrt(spread) : std::nan("");
  }
  [[nodiscard]] double rmse(double Score::*error) const { return std::sqrt(this->*error / count); }
};

std::string share(double part, double whole) {
  return whole > 0 ? fmt::format("{:.1f}", 100 * part / whole) : "-";
}

std::string cells(const Score& score) {
  const double c = score.correlation();
  return fmt::format("{} | {} | {} | {} | {} | {:.3f} | {:.3f} | {:.3f} |",
                     share(score.shadowed, score.count), share(score.right, score.count),
                     share(score.found, score.shadowed), share(score.wrongly, score.count - score.shadowed),
                     std::isnan(c) ? "-" : fmt::format("{:.2f}", c), score.rmse(&Score::error_none),
                     score.rmse(&Score::error_soft), score.rmse(&Score::error_hard));
}

constexpr const char* head =
    "in shadow % | right % | found % | wrongly % | correlation | RMSE unshadowed | soft | hard |\n";

/// All directions of one case; one score for each elevation.
class Comparison {
 public:
  Comparison(const Case& shape, NormalShadowOptions options)
      : shape_(shape), options_(options), rays_(shape.field) {}

  std::array<Score, elevations.size()> run() {
    std::array<Score, elevations.size()> scores;
    for (int azimuth = 0; azimuth < azimuths; ++azimuth) {
      const double angle = 2 * pi * (azimuth + 0.3) / azimuths;  // off the axes and diagonals
      const FloatImage horizon = horizon_of(angle);
      for (std::size_t i = 0; i < elevations.size(); ++i)
        add(horizon, angle, elevations[i] * pi / 180, scores[i]);
    }
    return scores;
  }

  Score sum() {
    Score total;
    for (const Score& score : run()) total += score;
    return total;
  }

 private:
  [[nodiscard]] FloatImage horizon_of(double angle) const {
    const Vec2 towards(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)));
    const double floor = std::tan(elevations[0] * pi / 180) * 0.99;
    FloatImage horizon(shape_.field.width(), shape_.field.height(), 1);
    for (int y = 0; y < horizon.height(); ++y)
      for (int x = 0; x < horizon.width(); ++x)
        horizon.texel(x, y)[0] = static_cast<float>(rays_.horizon_slope(x, y, towards, floor));
    return horizon;
  }

  void add(const FloatImage& horizon, double angle, double elevation, Score& score) const {
    const Vec3 light(Vec3d(std::cos(angle) * std::cos(elevation), std::sin(angle) * std::cos(elevation),
                           std::sin(elevation)));
    NormalShadowOptions hard_options = options_;
    hard_options.hard = true;
    const FloatImage soft = normal_shadows(shape_.walked, light, options_);
    const FloatImage hard = normal_shadows(shape_.walked, light, hard_options);
    for (int y = 0; y < soft.height(); ++y) {
      for (int x = 0; x < soft.width(); ++x) {
        const auto n = shape_.normals.texel(x, y);
        const double lit = light.dot(Vec3(n[0], n[1], n[2]));
        if (lit <= 0) continue;
        score.add(lit,
                  horizon.texel(x, y)[0]<std::tan(elevation), soft.texel(x, y)[0], hard.texel(x, y)[0]> 0.5F);
      }
    }
  }

  const Case& shape_;
  NormalShadowOptions options_;
  HeightRays rays_;
};

void write_cases(const std::vector<Case>& cases) {
  std::cout << "| surface | slope RMS | curl | " << head << "|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Case& one : cases) {
    std::cout << fmt::format("| {} | {:.2f} | {:.2f} | ", one.name, slope_rms(one),
                             slope_curl(one.walked, {.scale = 4}).relative)
              << cells(Comparison(one, {}).sum()) << "\n"
              << std::flush;
  }
  std::cout << "\nThe same with `--true-slopes`:\n\n| surface | " << head
            << "|---|---|---|---|---|---|---|---|---|\n";
  for (const Case& one : cases)
    std::cout << fmt::format("| {} | ", one.name) << cells(Comparison(one, {.true_slopes = true}).sum())
              << "\n";
}

void write_elevations(const std::vector<Case>& cases) {
  std::array<Score, elevations.size()> totals;
  for (const Case& one : cases) {
    const auto scores = Comparison(one, {}).run();
    for (std::size_t i = 0; i < totals.size(); ++i) totals[i] += scores[i];
  }
  std::cout << "\n| light's elevation | " << head << "|---|---|---|---|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < totals.size(); ++i)
    std::cout << fmt::format("| {:g} degrees | ", elevations[i]) << cells(totals[i]) << "\n";
}

void write_variants(const Case& shape) {
  const auto row = [](const std::string& name, const Case& one, const NormalShadowOptions& options) {
    std::cout << fmt::format("| {} | ", name) << cells(Comparison(one, options).sum()) << "\n" << std::flush;
  };
  std::cout << fmt::format("\n| {} | ", shape.name) << head << "|---|---|---|---|---|---|---|---|---|\n";
  row("as published", shape, {});
  row("jitter", shape, {.jitter = 1});
  row("steps 8", shape, {.steps = 8});
  row("steps 56 (one texel each)", shape, {.steps = 56});
  row("steps 128", shape, {.steps = 128});
  row("length 0.11", shape, {.length = 0.11F});
  row("length 0.44, steps 64", shape, {.length = 0.44F, .steps = 64});
  row("hardness 4", shape, {.hardness = 4.0F});
  row("hardness 44", shape, {.hardness = 44.0F});
  const auto walk_over = [&](const std::string& name, FloatImage walked, const NormalShadowOptions& options) {
    row(name, {shape.name, shape.field, shape.normals, std::move(walked)}, options);
  };
  walk_over("normals of 8 bits", eight_bit(shape.normals), {});
  walk_over("green channel the wrong way", flipped_green(shape.normals), {});
  row("true slopes", shape, {.true_slopes = true});
  row("true slopes, steps 128", shape, {.steps = 128, .true_slopes = true});
  row("true slopes, steps 128, hardness 44", shape, {.steps = 128, .hardness = 44.0F, .true_slopes = true});
}

void write_all(const std::filesystem::path& heightmaps) {
  std::vector<Case> cases = generated_surfaces();
  std::optional<Published> rock;
  std::string correlations;
  if (!heightmaps.empty()) {
    const auto add = [&](const Published& one) {
      cases.push_back(one.own);
      cases.push_back(one.theirs);
      correlations +=
          fmt::format("{}{} {:.2f}", correlations.empty() ? "" : ", ", one.own.name, one.correlation);
    };
    rock = published(heightmaps / "rock023/rock023_alb_ht.png", 3, heightmaps / "rock023/rock023_nrm_rgh.png",
                     "rock023", 1);
    add(*rock);
    add(published(heightmaps / "rock058/displacement.jpg", 0, heightmaps / "rock058/normal.jpg", "rock058",
                  1));
    add(published(heightmaps / "cube/cube_depth.png", 0, heightmaps / "cube/cube_normal.png", "cube", -1));
  }
  write_cases(cases);
  if (rock) {
    std::cout << "\nCorrelation of the slopes of published normal maps with those of their heights: "
              << correlations << ".\n";
  }
  write_elevations(cases);
  write_variants(rock ? rock->own : cases[5]);
}

}  // namespace
}  // namespace rnmbake

int main(int argc, char** argv) {
  CLI::App app{"Normal mapping shadows against exact ones"};
  std::string heightmaps;
  app.add_option("--heightmaps", heightmaps, "folder of rock023, rock058 and cube");
  CLI11_PARSE(app, argc, argv);
  try {
    rnmbake::write_all(heightmaps);
  } catch (const rnmbake::Error& error) {
    std::cerr << "bench_nms: " << error.what() << "\n";
    return static_cast<int>(error.code());
  }
  return 0;
}
