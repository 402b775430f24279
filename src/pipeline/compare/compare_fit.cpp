#include "pipeline/compare/compare_fit.h"

#include "base/error.h"
#include "encoding/encodings.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {
namespace {

constexpr float same_direction = 1e-3F;

class Fit {
 public:
  Fit(const std::string& key, const LoadedLightmap& one, const LoadedLightmap& other)
      : key_(key), one_(one), other_(other) {}

  void same(const char* what, const std::string& a, const std::string& b, const char* remedy) const {
    if (a == b) return;
    fail(ExitCode::invalid_input, "'{}' cannot be compared: {} is {} in {} and {} in {}; {}", key_, what, a,
         one_.file, b, other_.file, remedy);
  }

 private:
  const std::string& key_;
  const LoadedLightmap &one_, &other_;
};

std::string size_of(const LoadedLightmap& lightmap) {
  const FloatImage& pixels = lightmap.image.layers.front().pixels;
  return fmt::format("{}x{}", pixels.width(), pixels.height());
}

std::string written(const Vec3& v) {
  return fmt::format("({:.4f}, {:.4f}, {:.4f})", v.x, v.y, v.z);
}

void check_directions(const Fit& fit, const LightmapMetadata& one, const LightmapMetadata& other) {
  for (const BasisDirection& basis : one.bases) {
    const auto found = std::ranges::find(other.bases, basis.name, &BasisDirection::name);
    if (found == other.bases.end() || (found->direction - basis.direction).length() < same_direction)
      continue;
    fit.same(("the direction of basis " + basis.name).c_str(), written(basis.direction),
             written(found->direction), "bake both with one --basis");
  }
}

}  // namespace

void check_fit(const std::string& key, const LoadedLightmap& one, const LoadedLightmap& other) {
  const Fit fit(key, one, other);
  const LightmapMetadata &a = one.metadata, &b = other.metadata;
  fit.same("the size", size_of(one), size_of(other), "give both the same --resolution");
  fit.same("the convention", a.convention, b.convention, "bake both with one rnmbake");
  fit.same("the unit", a.units, b.units, "bake both with one rnmbake");
  fit.same("the space", a.space, b.space, "bake both with one rnmbake");
  fit.same("the handedness", a.handedness, b.handedness, "bake both with one rnmbake");
  fit.same("green", name_of(a.green), name_of(b.green), "give both or neither --flip-green");
  fit.same("normalize", name_of(a.normalize), name_of(b.normalize), "give both the same --normalize");
  check_directions(fit, a, b);
}

void check_halves(const std::string& key, const LoadedLightmap& first, const LoadedLightmap& second) {
  check_fit(key, first, second);
  if (first.metadata.seed != second.metadata.seed) return;
  fail(
      ExitCode::invalid_input,
      "'{}': {} and {} have the same seed, {}, so their difference is no noise; bake one with another --seed",
      key, first.file, second.file, first.metadata.seed);
}

const FloatImage* basis_layer(const LoadedLightmap& lightmap, const std::string& basis,
                              const std::string& suffix) {
  const Layer* layer = lightmap.image.find(suffix.empty() ? exr_layer(basis) : basis + suffix);
  return layer == nullptr ? nullptr : &layer->pixels;
}

std::vector<std::string> common_bases(const std::vector<const LoadedLightmap*>& lightmaps) {
  std::vector<std::string> names;
  for (const BasisDirection& basis : lightmaps.front()->metadata.bases) {
    if (std::ranges::all_of(lightmaps, [&](const LoadedLightmap* lightmap) {
          return basis_layer(*lightmap, basis.name) != nullptr;
        }))
      names.push_back(basis.name);
  }
  return names;
}

}  // namespace rnmbake
