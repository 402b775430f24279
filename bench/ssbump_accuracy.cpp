// bench/ssbump_accuracy.cpp - self-shadowed bump maps against the truth: the tables of
// docs/ssbump-methods.md, which bench/ssbump_accuracy.py puts there.
//
// Prints one JSON object a line as soon as it is measured, and the same for people on the standard error.
#include "base/error.h"
#include "sampled_weights.h"
#include "ssbump/generate/generate.h"
#include "ssbump_closed_forms.h"
#include "ssbump_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/task_arena.h>

namespace rnmbake {
namespace {

using json = nlohmann::ordered_json;

constexpr int texel_count = 96, in_the_middle = 12,
              first_column = 122;  // one of those in each of the columns
constexpr std::uint64_t seed = 2;

struct Arguments {
  std::vector<std::string> settings{"default", "128/16"};
  std::vector<std::string> parts{"forms", "seam", "horizons", "rays"};
  std::vector<float> factors{0.25F, 1.0F, 4.0F};
  std::string heightmaps, only;
  int azimuths = 1024, rays = 65536;  // of the truths
  int threads = 2;

  [[nodiscard]] bool wants(const std::string& part) const { return std::ranges::count(parts, part) > 0; }
};

/// Azimuths and near rows of the sweep.
struct Setting {
  std::string name;
  GenerateOptions options;
};

Setting parse_setting(const std::string& text) {
  Setting setting{text, {}};
  if (text == "default") return setting;
  const int read = std::sscanf(text.c_str(), "%d/%d", &setting.options.azimuths, &setting.options.near_rows);
  if (read != 2) fail(ExitCode::usage, "--settings {}: no such setting; give azimuths/rows, as 128/16", text);
  return setting;
}

std::vector<Texel> texels_of(const HeightField& field) {
  std::vector<Texel> texels = spread_texels(field.width(), field.height(), texel_count);
  for (int i = 0; i < in_the_middle; ++i) texels[static_cast<std::size_t>(i)].x = first_column + i;
  return texels;
}

json as_json(const WeightErrors& errors) {
  return {{"rmse", errors.rmse}, {"max", errors.largest}};
}

HeightField scaled(const SsbumpMap& map, WrapMode border, float factor) {
  HeightField field{map.heights, border, border};
  for (float& height : field.heights.data()) height *= factor;
  return field;
}

class Measurement {
 public:
  explicit Measurement(const Arguments& arguments) : arguments_(arguments) {
    for (const std::string& text : arguments.settings) settings_.push_back(parse_setting(text));
    maps_ = generated_maps();
    if (arguments.heightmaps.empty()) {
      std::cerr << "WITHOUT the real maps: give their folder with --heightmaps\n";
    } else {
      for (SsbumpMap& map : real_maps(arguments.heightmaps)) maps_.push_back(std::move(map));
    }
    std::erase_if(maps_,
                  [&](const SsbumpMap& map) { return map.name.find(arguments.only) == std::string::npos; });
  }

  void run() const {
    if (arguments_.wants("forms")) {
      for (const ClosedForm& form : closed_forms()) against_closed_form(form);
    }
    if (arguments_.wants("seam")) {
      for (const SsbumpMap& map : maps_) across_seam(map);
    }
    if (arguments_.wants("horizons")) {
      for (const WrapMode border : {WrapMode::wrap, WrapMode::none})
        for (const SsbumpMap& map : maps_)
          for (const float factor : arguments_.factors) against_horizons(map, border, factor);
    }
    if (arguments_.wants("rays")) {
      for (const SsbumpMap& map : maps_) against_rays(map);
    }
  }

 private:
  /// `row` gets the errors of each setting.
  void measure(json row, const HeightField& field, const std::vector<Texel>& texels,
               const std::vector<Channels>& truth) const {
    measure(std::move(row), field, texels, truth, settings_);
  }
  static void measure(json row, const HeightField& field, const std::vector<Texel>& texels,
                      const std::vector<Channels>& truth, const std::vector<Setting>& settings) {
    for (const Setting& setting : settings) {
      const SsbumpWeights weights = generate(field, setting.options);
      json& errors = row["settings"][setting.name] = as_json(errors_of(picked(weights, texels), truth));
      errors["azimuths"] = weights.azimuths;
      if (weights.rmse >= 0) errors["estimate"] = weights.rmse;
    }
    report(row);
  }

  void against_horizons(const SsbumpMap& map, WrapMode border, float factor) const {
    const HeightField field = scaled(map, border, factor);
    const std::vector<Texel> texels = texels_of(field);
    measure({{"part", "horizons"},
             {"map", map.name},
             {"border", border == WrapMode::wrap ? "wrap" : "none"},
             {"factor", factor}},
            field, texels, by_horizons(field, texels, arguments_.azimuths));
  }

  void against_rays(const SsbumpMap& map) const {
    const HeightField field = scaled(map, WrapMode::wrap, 1);
    const std::vector<Texel> texels = texels_of(field);
    const HemisphereRays rays(arguments_.rays, 1, seed);
    const std::vector<Channels> truth = by_rays(field, texels, rays.set(0));
    const WeightErrors apart = errors_of(truth, by_horizons(field, texels, arguments_.azimuths));
    measure({{"part", "rays"}, {"map", map.name}, {"truths_apart", as_json(apart)}}, field, texels, truth);
  }

  /// With a finer error as well: what is asked for here is finer, too.
  void against_closed_form(const ClosedForm& form) const {
    Setting fine{"--error 1e-4", {}};
    fine.options.error = 1e-4;
    std::vector<Setting> settings = settings_;
    settings.insert(settings.begin() + 1, fine);
    const std::vector<Texel> texels{form.texel};
    const std::vector<Channels> truth{form.weights};
    measure({{"part", "forms"},
             {"map", form.name},
             {"ambient", form.weights[SsbumpWeights::ambient]},
             {"truth", as_json(errors_of(by_horizons(form.field, texels, arguments_.azimuths), truth))}},
            form.field, texels, truth, settings);
  }

  /// Half the map on, and back again.
  void across_seam(const SsbumpMap& map) const {
    const HeightField field = scaled(map, WrapMode::wrap, 1);
    const int width = field.width(), height = field.height();
    const auto over = [&](int x, int y) { return Texel{(x + width / 2) % width, (y + height / 2) % height}; };
    const HeightField moved = field_of(width, height, WrapMode::wrap, [&](int x, int y) {
      return field.heights.texel(over(x, y).x, over(x, y).y)[0];
    });
    std::vector<Texel> here, there;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        here.push_back({x, y});
        there.push_back(over(x, y));
      }
    }
    json row{{"part", "seam"}, {"map", map.name}};
    for (const Setting& setting : settings_) {
      row["settings"][setting.name] = as_json(errors_of(picked(generate(moved, setting.options), here),
                                                        picked(generate(field, setting.options), there)));
    }
    report(row);
  }

  static void report(const json& row) {
    std::cout << row.dump() << std::endl;
    std::string text =
        fmt::format("{:8} {:58}", row["part"].get<std::string>(), row["map"].get<std::string>());
    if (row.contains("border"))
      text += fmt::format(" {} x{:<4g}", row["border"].get<std::string>(), row["factor"].get<double>());
    for (const auto& [name, errors] : row["settings"].items()) {
      text += fmt::format(" | {}: {:.6f} {:.5f}", name, errors["rmse"].get<double>(),
                          errors["max"].get<double>());
      if (errors.contains("estimate"))
        text += fmt::format(" ({}, {:.6f})", errors["azimuths"].get<int>(), errors["estimate"].get<double>());
    }
    std::cerr << text << std::endl;
  }

  const Arguments& arguments_;
  std::vector<Setting> settings_;
  std::vector<SsbumpMap> maps_;
};

}  // namespace
}  // namespace rnmbake

int main(int argc, char** argv) {
  rnmbake::Arguments arguments;
  CLI::App app{"Self-shadowed bump maps against the truth"};
  app.add_option("--settings", arguments.settings, "default, or azimuths/near rows; several")->delimiter(',');
  app.add_option("--parts", arguments.parts, "forms, seam, horizons, rays")->delimiter(',');
  app.add_option("--heightmaps", arguments.heightmaps, "folder of cube, rock023 and rock058");
  app.add_option("--factors", arguments.factors, "of the heights, against horizons")->delimiter(',');
  app.add_option("--only", arguments.only, "maps whose name has this in it");
  app.add_option("--azimuths", arguments.azimuths, "of the exact horizons");
  app.add_option("--rays", arguments.rays, "of the truth by rays");
  app.add_option("--threads", arguments.threads);
  CLI11_PARSE(app, argc, argv);
  try {
    tbb::task_arena arena(arguments.threads);
    arena.execute([&] { rnmbake::Measurement(arguments).run(); });
  } catch (const rnmbake::Error& error) {
    std::cerr << "bench_ssbump_accuracy: " << error.what() << "\n";
    return static_cast<int>(error.code());
  }
  return 0;
}
