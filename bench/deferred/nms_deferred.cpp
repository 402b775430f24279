// Deferred normal mapping shadows over the G-buffer of a scene, by normal_shadows_deferred.glsl itself,
// against the exact shadows of the scene's reliefs: the tables and the picture of
// docs/normal-mapping-shadows.md, which bench/nms_deferred.py puts there.
//
//   bench_nms_deferred cobbles.rnmscene --reliefs reliefs.json --character figure --picture deferred.png
#include "base/error.h"
#include "deferred_picture.h"
#include "deferred_scene.h"
#include "deferred_score.h"
#include "support/deferred_shadows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace rnmbake {
namespace {

constexpr int width = 640, height = 400;
constexpr float pattern_side = 1.6F;  // scenes/cobbles.py
constexpr float walk_length = 0.22F;  // published, of the pattern's side
constexpr float no_range = 1e7F;      // of a depth test that everything passes
constexpr std::array ranges{0.05F, 0.1F, 0.2F, 0.4F, 0.8F, 1.6F};
constexpr float usual_range = 0.4F;
constexpr std::array azimuths{-165.0, -120.0, -75.0, -30.0};  // from +x; the wall is in the way of others
constexpr std::array elevations{20.0, 35.0, 50.0};

Vec3 sun_at(double azimuth, double elevation) {
  return Vec3(direction_at((90 - elevation) * pi / 180, azimuth * pi / 180));
}

/// What the shader says of a scene, with the remedies against false shadows over edges of depth.
class Remedies {
 public:
  explicit Remedies(const DeferredScene& scene)
      : scene_(scene), all_(input_of(scene.all())), static_(input_of(scene.static_world())) {}

  [[nodiscard]] FloatImage none(const Vec3& sun) { return run(all_, all_.depths, no_range, sun); }
  [[nodiscard]] FloatImage depth_test(const Vec3& sun, float range) {
    return run(all_, all_.depths, range, sun);
  }

  /// Pixels of the character neither shadow others nor are shadowed.
  [[nodiscard]] FloatImage character_stencil(const Vec3& sun, float range = no_range) {
    FloatImage depths = all_.depths;
    for (std::size_t i = 0; i < depths.texels(); ++i)
      if (object(i) == scene_.character()) depths.data()[i] = 1e9F;
    return without_character(run(all_, depths, range, sun));
  }

  /// Each object is shadowed by its own pixels alone.
  [[nodiscard]] FloatImage object_stencil(const Vec3& sun, float range = no_range) {
    const FloatImage& objects = scene_.all().object;
    FloatImage result(width, height, 1);
    for (const float number : std::set<float>(objects.data().begin(), objects.data().end())) {
      const FloatImage left = run(all_, stencilled(all_.depths, objects, number), range, sun);
      for (std::size_t i = 0; i < result.texels(); ++i)
        if (object(i) == number) result.data()[i] = left.data()[i];
    }
    return result;
  }

  /// Shadows of the static world, before the character is drawn over it.
  [[nodiscard]] FloatImage pass_before(const Vec3& sun, float range = no_range) {
    return without_character(run(static_, static_.depths, range, sun));
  }

 private:
  [[nodiscard]] DeferredInput input_of(const GBuffer& gbuffer) const {
    DeferredInput input;
    input.normals = scene_.to_view(gbuffer.normal);
    input.depths = gbuffer.depth;
    input.walk = scene_.uv_of_length() * (walk_length * pattern_side);
    input.hardness = 50 * walk_length;
    return input;
  }
  [[nodiscard]] FloatImage run(DeferredInput& input, const FloatImage& tested, float range, const Vec3& sun) {
    input.tested = tested;
    input.range = range;
    return deferred_shadows(compute_, input, scene_.to_view(sun));
  }
  [[nodiscard]] float object(std::size_t pixel) const { return scene_.all().object.data()[pixel]; }
  [[nodiscard]] FloatImage without_character(FloatImage left) const {
    for (std::size_t i = 0; i < left.texels(); ++i)
      if (object(i) == scene_.character()) left.data()[i] = 1;
    return left;
  }

  const DeferredScene& scene_;
  DeferredInput all_, static_;
  GlCompute compute_;
};

struct Way {
  std::string name;
  std::function<FloatImage(const LitPixels&, const Vec3&)> left;
  bool in_short = true;  // also in the table by elevation
};

std::vector<Way> ways(Remedies& remedies) {
  std::vector<Way> list;
  list.push_back({"no shadows", [](const LitPixels& lit, const Vec3&) {
                    FloatImage ones = lit.truth;
                    std::ranges::fill(ones.data(), 1.0F);
                    return ones;
                  }});
  list.push_back({"in texture space", [](const LitPixels& lit, const Vec3&) { return lit.forward; }});
  const auto add = [&](const std::string& name, auto left, bool in_short = true) {
    list.push_back({name, [left](const LitPixels&, const Vec3& sun) { return left(sun); }, in_short});
  };
  add("deferred, no remedy", [&](const Vec3& sun) { return remedies.none(sun); });
  for (const float range : ranges)
    add(
        fmt::format("depth test, {:g}", range),
        [&, range](const Vec3& sun) { return remedies.depth_test(sun, range); }, range == usual_range);
  add("stencil of the figure", [&](const Vec3& sun) { return remedies.character_stencil(sun); });
  add("stencil of every object", [&](const Vec3& sun) { return remedies.object_stencil(sun); });
  add("static world first", [&](const Vec3& sun) { return remedies.pass_before(sun); });
  add(
      fmt::format("stencil of the figure, depth test {:g}", usual_range),
      [&](const Vec3& sun) { return remedies.character_stencil(sun, usual_range); }, false);
  add(
      fmt::format("stencil of every object, depth test {:g}", usual_range),
      [&](const Vec3& sun) { return remedies.object_stencil(sun, usual_range); }, false);
  add(
      fmt::format("static world first, depth test {:g}", usual_range),
      [&](const Vec3& sun) { return remedies.pass_before(sun, usual_range); }, false);
  return list;
}

void write_tables(const DeferredScene& scene, Remedies& remedies) {
  const Regions regions(scene.all(), scene.character());
  const std::vector<Way> list = ways(remedies);
  std::vector<std::array<RegionScores, elevations.size()>> scores(list.size());
  for (std::size_t high = 0; high < elevations.size(); ++high) {
    for (const double azimuth : azimuths) {
      const Vec3 sun = sun_at(azimuth, elevations[high]);
      const LitPixels lit = scene.lit(sun);
      for (std::size_t i = 0; i < list.size(); ++i) scores[i][high].add(regions, lit, list[i].left(lit, sun));
    }
  }
  std::cout << heading(regions);
  for (std::size_t i = 0; i < list.size(); ++i) {
    RegionScores total;
    for (const RegionScores& part : scores[i]) total += part;
    std::cout << fmt::format("| {} | {}\n", list[i].name, cells(total));
    if (i + 1 == list.size()) std::cout << shadowed_share(total);
  }
  std::cout << elevation_heading(elevations);
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i].in_short) std::cout << fmt::format("| {} | {}\n", list[i].name, band_cells(scores[i]));
}

void write_picture(const std::string& file, const DeferredScene& scene, Remedies& remedies) {
  const Vec3 sun = sun_at(azimuths[0], elevations[0]);
  const LitPixels lit = scene.lit(sun);
  FloatImage ones = lit.truth;
  std::ranges::fill(ones.data(), 1.0F);
  write_panels(file, lit,
               {ones, lit.truth, remedies.none(sun), remedies.depth_test(sun, usual_range),
                remedies.character_stencil(sun), remedies.pass_before(sun)});
}

void measure(const std::string& file, const std::string& reliefs, const std::string& character,
             const std::string& picture) {
  const DeferredScene scene(file, read_reliefs(reliefs), character, width, height);
  Remedies remedies(scene);
  if (!picture.empty()) write_picture(picture, scene, remedies);
  write_tables(scene, remedies);
}

}  // namespace
}  // namespace rnmbake

int main(int argc, char** argv) {
  CLI::App app{"Deferred normal mapping shadows over a scene's G-buffer against exact ones"};
  std::string scene, reliefs, character, picture;
  app.add_option("scene", scene, "a .rnmscene")->required();
  app.add_option("--reliefs", reliefs, "JSON: the heights of objects, in texels")->required();
  app.add_option("--character", character, "the object that moves")->required();
  app.add_option("--picture", picture, "PNG to write");
  CLI11_PARSE(app, argc, argv);
  try {
    rnmbake::measure(scene, reliefs, character, picture);
  } catch (const rnmbake::Error& error) {
    std::cerr << "bench_nms_deferred: " << error.what() << "\n";
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {  // no EGL
    std::cerr << "bench_nms_deferred: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
