// bench/ssbump_directions.cpp - self-shadowed bump maps of more directions under a moving sun: the table of
// docs/ssbump-methods.md that bench/ssbump_directions.py puts there.
//
// Prints one JSON object a line.
#include "base/error.h"
#include "encoding/direction_sets.h"
#include "encoding/rnm.h"
#include "ssbump/directions/direction_rows.h"
#include "ssbump/generate/generate.h"
#include "ssbump/heights/height_shadows.h"
#include "ssbump/map/normals.h"
#include "ssbump_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>

namespace rnmbake {
namespace {

using json = nlohmann::ordered_json;

struct Arguments {
  std::string heightmaps;
  int rays = 512, elevations = 6, azimuths = 8;
};

/// Evenly over the upper hemisphere, `elevations` rings; of each ring the azimuths are half a step on.
std::vector<Vec3> suns_of(const Arguments& arguments) {
  std::vector<Vec3> suns;
  for (int i = 0; i < arguments.elevations; ++i) {
    const double tilt = std::acos((i + 0.5) / arguments.elevations);
    for (int k = 0; k < arguments.azimuths; ++k)
      suns.emplace_back(direction_at(tilt, 2 * pi * (k + 0.5 * (i % 2)) / arguments.azimuths));
  }
  return suns;
}

constexpr int every_row = 8;  // so many rows on is the next that is looked at

/// Light of a sun of E/pi 1 straight above that texel (x, y) receives.
using Light = std::function<double(int x, int y, const Vec3& sun)>;

/// Least squares of the light against the truth; contrast is covariance over the truth's variance, sun by
/// sun.
struct Comparison {
  double squares = 0, covariance = 0, variance = 0, below = 0, texels = 0;

  void add_sun(const std::vector<double>& truth, const std::vector<double>& light) {
    const auto count = static_cast<double>(truth.size());
    double truths = 0, lights = 0, products = 0, truth_squares = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const double seen = std::max(0.0, light[i]);
      squares += (seen - truth[i]) * (seen - truth[i]);
      truths += truth[i];
      lights += seen;
      products += truth[i] * seen;
      truth_squares += truth[i] * truth[i];
      below += light[i] < -1e-6 ? 1 : 0;
    }
    covariance += products - truths * lights / count;
    variance += truth_squares - truths * truths / count;
    texels += count;
  }
};

class Measurement {
 public:
  Measurement(const SsbumpMap& map, const Arguments& arguments)
      : name_(map.name),
        field_{map.heights, WrapMode::wrap, WrapMode::wrap},
        arguments_(arguments),
        suns_(suns_of(arguments)),
        normals_(height_normals(field_, 0, field_.height())) {
    const HeightRays rays(field_);
    for (const Vec3& sun : suns_)
      truths_.push_back(over_rows([&](int x, int y) {
        const auto n = normals_.texel(x, y);
        const double cosine = double{sun.dot(Vec3(n[0], n[1], n[2]))};
        return cosine > 0 && !rays.occluded(x, y, sun) ? cosine : 0;
      }));
  }

  void run() const {
    report({{"weights", "no shadow"}, {"set", "normal map"}, {"channels", 0}},
           [&](int x, int y, const Vec3& sun) {
             const auto n = normals_.texel(x, y);
             return double{std::max(0.0F, sun.dot(Vec3(n[0], n[1], n[2])))};
           });
    for (const double power : {1.0, 4.0}) axes(power);
    BasisSet three = rnm_set();
    three.name = "three axes";
    BasisSet four = flat_and_rnm();
    four.name = "flat and three axes";
    for (const BasisSet& set :
         {three, four, *direction_set("l1"), *direction_set("h6"), *direction_set("sh3")})
      for (const WeightSign sign : {WeightSign::free, WeightSign::positive}) directions(set, sign);
  }

 private:
  [[nodiscard]] std::vector<double> over_rows(const std::function<double(int x, int y)>& value) const {
    std::vector<double> values(static_cast<std::size_t>(field_.width() * rows()));
    tbb::parallel_for(0, rows(), [&](int row) {
      for (int x = 0; x < field_.width(); ++x)
        values[static_cast<std::size_t>(row * field_.width() + x)] = value(x, row * every_row);
    });
    return values;
  }
  [[nodiscard]] int rows() const { return field_.height() / every_row; }

  /// The maps of three axes, and with the fourth channel; lightmaps scaled to the flat bake.
  void axes(double power) const {
    GenerateOptions options;
    options.power = power;
    const FloatImage weights = generate(field_, options).image;
    const auto basis = rnm_basis();
    for (const bool has_up : {false, true}) {
      const Light light = [&](int x, int y, const Vec3& sun) {
        const auto w = weights.texel(x, y);
        std::array<float, 3> maps{};
        for (std::size_t i = 0; i < 3; ++i) maps[i] = std::max(0.0F, sun.dot(basis[i]));
        const float scale = 3 * sun.z / (maps[0] + maps[1] + maps[2]);
        for (float& map : maps) map *= scale;
        const float least = has_up ? *std::ranges::min_element(maps) : 0;
        float sum = has_up ? least * w[SsbumpWeights::up] : 0;
        for (std::size_t i = 0; i < 3; ++i) sum += w[i] * (maps[i] - least) / 3;
        return double{sum};
      };
      report({{"weights", has_up ? "visibility, and up" : "visibility"},
              {"set", "three axes"},
              {"power", power},
              {"channels", has_up ? 4 : 3}},
             light);
    }
  }

  void directions(const BasisSet& set, WeightSign sign) const {
    FloatImage weights(field_.width(), rows(), static_cast<int>(set.directions.size()));
    const DirectionRows directions(field_, {set, sign, arguments_.rays, 0, 0});
    for (int row = 0; row < rows(); ++row) {
      const int y = row * every_row;
      const FloatImage one = directions.rows(y, y + 1);
      std::ranges::copy(one.data(), weights.texel(0, row).data());
    }
    const Light light = [&](int x, int y, const Vec3& sun) {
      const auto w = weights.texel(x, y / every_row);
      double sum = 0;
      for (std::size_t i = 0; i < w.size(); ++i)
        sum += double{w[i] * std::max(0.0F, sun.dot(set.directions[i].direction))};
      return sum;
    };
    double magnitude = 0;
    for (const float weight : weights.data()) magnitude += double{weight} * double{weight};
    report({{"weights", sign == WeightSign::free ? "free" : "positive"},
            {"set", set.name},
            {"channels", weights.channels()},
            {"noise", std::sqrt(magnitude / static_cast<double>(weights.texels()))}},
           light);
  }

  void report(json row, const Light& light) const {
    Comparison comparison;
    for (std::size_t sun = 0; sun < suns_.size(); ++sun) {
      comparison.add_sun(truths_[sun], over_rows([&](int x, int y) { return light(x, y, suns_[sun]); }));
    }
    row["map"] = name_;
    row["rmse"] = std::sqrt(comparison.squares / comparison.texels);
    row["contrast"] = comparison.covariance / comparison.variance;
    row["below"] = comparison.below / comparison.texels;
    std::cout << row.dump() << std::endl;
  }

  std::string name_;
  HeightField field_;
  const Arguments& arguments_;
  std::vector<Vec3> suns_;
  FloatImage normals_;
  std::vector<std::vector<double>> truths_;
};

/// A flat map is nothing to compare; the others beside these say the same at a greater length.
bool is_compared(const SsbumpMap& map) {
  constexpr std::array names{"two sinusoids", "hard steps", "rock 023", "rock 058"};
  return std::ranges::any_of(names, [&](const char* name) { return map.name.starts_with(name); });
}

void run(const Arguments& arguments) {
  std::vector<SsbumpMap> maps = generated_maps();
  if (arguments.heightmaps.empty()) {
    std::cerr << "WITHOUT the real maps: give their folder with --heightmaps\n";
  } else {
    for (SsbumpMap& map : real_maps(arguments.heightmaps)) maps.push_back(std::move(map));
  }
  for (const SsbumpMap& map : maps)
    if (is_compared(map)) Measurement(map, arguments).run();
}

}  // namespace
}  // namespace rnmbake

int main(int argc, char** argv) {
  rnmbake::Arguments arguments;
  CLI::App app{"Self-shadowed bump maps of more directions under a moving sun"};
  app.add_option("--heightmaps", arguments.heightmaps, "folder of cube, rock023 and rock058");
  app.add_option("--rays", arguments.rays, "for each texel's weights");
  app.add_option("--elevations", arguments.elevations, "of the sun, even in solid angle");
  app.add_option("--azimuths", arguments.azimuths, "of the sun at each elevation");
  CLI11_PARSE(app, argc, argv);
  try {
    rnmbake::run(arguments);
  } catch (const rnmbake::Error& error) {
    std::cerr << "bench_ssbump_directions: " << error.what() << "\n";
    return static_cast<int>(error.code());
  }
  return 0;
}
