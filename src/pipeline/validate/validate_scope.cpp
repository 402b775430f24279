#include "pipeline/validate/validate_scope.h"

#include "pipeline/compare/compare.h"
#include "pipeline/validate/validate_finding.h"

#include <algorithm>
#include <cmath>

#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

constexpr double worth_tracing = 1e-4;

float brightest(const Vec3& color) {
  return std::max({color.x, color.y, color.z});
}

float brightest_albedo(const DiffuseScene& scene) {
  float most = 0;
  for (const SurfaceMaterial& material : scene.materials) {
    most = std::max(most, brightest(material.albedo));
    if (material.albedo_picture < 0) continue;
    for (const Vec3& texel : scene.pictures[static_cast<std::size_t>(material.albedo_picture)].texels)
      most = std::max(most, brightest(texel));
  }
  return std::min(most, 1.0F);
}

}  // namespace

std::vector<std::string> not_followed(const DiffuseScene& scene) {
  std::vector<std::string> lines;
  for (const OutsideModel& outside : scene.outside) {
    if (!outside.untraced.empty())
      lines.push_back(fmt::format("{}: {}", outside.owner, fmt::join(outside.untraced, ", ")));
  }
  return lines;
}

std::vector<std::string> scope_notes(const DiffuseScene& scene) {
  std::vector<std::string> notes;
  for (const std::string& line : not_followed(scene))
    notes.push_back("Not followed by the reference: " + line +
                    ". Where it matters a difference is no error of the bake.");
  return notes;
}

bool bounces_matter(const DiffuseScene& scene, int bounces) {
  return std::pow(brightest_albedo(scene), bounces + 1) > worth_tracing;
}

BounceLimit bounce_limit(int bounces, const std::filesystem::path& with,
                         const std::filesystem::path& without) {
  CompareOptions options;
  options.candidate = {with, {}, "with the limit"};
  options.reference = {without, {}, "reference"};
  options.with_maps = false;
  return {bounces, scene_bias(compare_lightmaps(options))};
}

}  // namespace rnmbake
