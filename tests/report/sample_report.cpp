// Writes reports with made-up numbers for tests/report/page_check.py.
//
//     sample_report FOLDER small|many|large     3 objects with everything; 200 of 64x64; 12 of 512x512

#include "report/finding.h"
#include "report/maps.h"
#include "report/thresholds.h"
#include "report/write.h"

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace rnmbake {
namespace {

const std::vector<std::string> basis_names{"flat", "rnm0", "rnm1", "rnm2"};

struct Textures {
  FloatImage candidate, second, reference, error, coverage;
};

/// A lamp's light over a floor, warm, with a shadow; the candidate is a little off where light grazes.
Textures make_pictures(int size, double offset, std::mt19937& random) {
  std::normal_distribution<double> normal(0, 1);
  Textures p{FloatImage(size, size, 3), FloatImage(size, size, 3), FloatImage(size, size, 3),
             FloatImage(size, size, 3), FloatImage(size, size, 1)};
  const double tint[3] = {1.0, 0.85, 0.62};
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double u = (x + 0.5) / size - 0.4, v = (y + 0.5) / size - 0.45, d = u * u + v * v;
      const double shadow = 1 / (1 + std::exp(-40 * (u + 0.6 * v + 0.25)));
      const double light = 0.08 + 0.9 * shadow * 0.05 / (0.05 + d);
      const double noise = 0.02 * std::sqrt(light);
      const double common[3] = {normal(random), normal(random), normal(random)};
      for (std::size_t c = 0; c < 3; ++c) {
        // Half of the variance is common to the colours, as where the lamps' light is of one colour.
        const auto draw = [&](int i) { return noise * (common[i] + normal(random)) / std::sqrt(2); };
        const double value = light * tint[c];
        const double biased = value * (1 + offset * (1 + std::sin(9 * u)) * (0.4 + d));
        p.candidate.texel(x, y)[c] = static_cast<float>(biased + 2 * draw(0));
        p.second.texel(x, y)[c] = static_cast<float>(biased + 2 * draw(1));
        p.reference.texel(x, y)[c] = static_cast<float>(value + draw(2));
        p.error.texel(x, y)[c] = static_cast<float>(noise);
      }
      const bool covered = x > size / 32 && y > size / 32 && !(x > size * 3 / 4 && y > size * 3 / 4);
      p.coverage.texel(x, y)[0] = covered ? 1 : 0;
    }
  }
  return p;
}

ObjectComparison make_object(const std::string& key, int size, int limit, std::mt19937& random,
                             std::vector<PictureComparison>& scene) {
  std::uniform_real_distribution<double> offsets(-0.05, 0.05);
  ObjectComparison object;
  object.key = key;
  object.candidate_files = object.reference_files = {key + ".exr"};
  object.width = object.height = size;
  object.coverage = 0.9;
  object.validity = 0.98;
  for (std::size_t i = 0; i < basis_names.size(); ++i) {
    const Textures p = make_pictures(size, offsets(random), random);
    const ComparedPicture candidate{&p.candidate, &p.second, nullptr};
    const ComparedPicture reference{&p.reference, nullptr, &p.error};
    PictureComparison comparison;
    comparison.add(candidate, reference, {{&p.coverage}});
    object.bases.push_back({basis_names[i], comparison.metrics()});
    object.maps.push_back(make_maps(basis_names[i], candidate, reference, {{&p.coverage}}, limit));
    scene[i].add(comparison);
  }
  return object;
}

Report make_report(const std::vector<std::string>& keys, int size) {
  std::mt19937 random(7);
  std::vector<PictureComparison> scene(basis_names.size());
  Report report;
  report.title = "hall.blend, recipe flat-normal-map";
  report.candidate_label = "Cycles 4.3.2";
  report.reference_label = "reference";
  const int limit = map_limit(keys.size(), basis_names.size());
  for (const std::string& key : keys) report.objects.push_back(make_object(key, size, limit, random, scene));
  for (std::size_t i = 0; i < basis_names.size(); ++i)
    report.scene.push_back({basis_names[i], scene[i].metrics()});
  report.settings = {{"Cycles 4.3.2: samples", "256"}, {"reference: samples", "1024"}};
  report.versions = {{"rnmbake", "0.1.0"}, {"Blender", "4.3.2"}};
  report.command = "rnmbake compare bakes truth --second-a bakes2 --fail-above rmse=2% -o report";
  report.finding = finding_of(report);
  return report;
}

Statistic around(double value, double reach) {
  return {value, value - reach, value + reach};
}

DecompositionRow row(const std::string& name, double bias, double rmse) {
  return {name, around(bias * 0.4, 0.001), around(rmse * 0.4, 0.001), around(bias, 0.003),
          around(rmse, 0.002)};
}

Decomposition make_decomposition(const std::string& subject) {
  Decomposition decomposition{subject, {}};
  double share = 1;
  for (const std::string& basis : basis_names) {
    decomposition.bases.push_back(
        {basis,
         0.4,
         {row("tilt clamp", -0.031 * share, 0.04), row("bump shadowing", -0.082 * share, 0.1),
          row("self-reflection", -0.024 * share, 0.03), row("light from below", 0.012 * share, 0.02),
          row("non-Lambertian diffuse", 0.006, 0.009), row("noise", 0.0002, 0.012),
          row("residual", 0.0006, 0.002)},
         row("total", -0.117 * share + 0.0068, 0.13)});
    share *= 0.9;
  }
  return decomposition;
}

FloatImage make_view(double gain) {
  FloatImage picture(320, 200, 3);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 320; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        picture.texel(x, y)[c] = static_cast<float>(
            gain * (0.1 + 0.4 * (0.5 + 0.5 * std::sin(x * 0.05 + double(c))) * (1 - y / 250.0)));
  return picture;
}

void add_everything_else(Report& report) {
  report.thresholds = check_thresholds(report, parse_thresholds("rmse=3%,bias=2%"));
  report.decompositions = {make_decomposition("scene"), make_decomposition("floor")};
  report.study.points = {{"whole", 12, 60, around(0.041, 0.004)},
                         {"material", 31, 74, around(0.033, 0.003)},
                         {"loose", 118, 130, around(0.021, 0.002)},
                         {"grid", 400, 410, around(0.012, 0.001)}};
  report.views = {{"Camera",
                   {{"Cycles", make_view(1), false, 0, 0, 0, 0},
                    {"single lightmap", make_view(0.9), true, 0.04, 0.11, -0.03, -0.1},
                    {"RNM, squared", make_view(1.02), true, 0.01, 0.03, 0.004, 0.02}}}};
  report.candidate_only = {"<b>lamp</b>"};
  report.reference_only = {"shelf"};
  report.objects.back().outside_model = {"glossy"};
  report.not_followed = {"light 'Lamp': node tree"};
  report.bounce_limit = {32, around(-0.064, 0.001)};
}

std::vector<std::string> numbered(int count) {
  std::vector<std::string> keys;
  keys.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) keys.push_back("column." + std::to_string(1000 + i).substr(1));
  return keys;
}

int write_sample(const std::string& folder, const std::string& kind) {
  if (kind == "many") {
    write_report(make_report(numbered(200), 64), folder);
  } else if (kind == "large") {
    write_report(make_report(numbered(12), 512), folder);
  } else {
    Report report = make_report({"floor", "wall", "</script><script>alert(1)</script>"}, 64);
    add_everything_else(report);
    write_report(report, folder);
  }
  return 0;
}

}  // namespace
}  // namespace rnmbake

int main(int count, char** arguments) {
  return count == 3 ? rnmbake::write_sample(arguments[1], arguments[2]) : 1;
}
