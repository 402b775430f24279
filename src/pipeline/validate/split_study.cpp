#include "pipeline/validate/split_study.h"

#include "base/log.h"
#include "base/text.h"
#include "config/recipe_names.h"
#include "pipeline/compare/compare.h"
#include "scene/uv_raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace rnmbake {
namespace {

constexpr std::size_t most_targets = 200;

/// The first target of every object, made whole again.
TargetList whole_objects(const ExportResult& exported) {
  TargetList list;
  list.skipped = exported.list.skipped;
  std::set<std::size_t> seen;
  for (std::size_t i = 0; i < exported.list.targets.size(); ++i) {
    Target target = exported.list.targets[i];
    if (!seen.insert(target.object).second) continue;
    const SceneSurvey& survey = exported.diffuse_scene.survey;
    const SceneObject& object = survey.objects[target.object];
    target.key = object.key;
    target.part = split_mesh(survey.mesh_of(object), object.slots, ObjectSettings::Split::none).front();
    list.targets.push_back(std::move(target));
    list.settings.push_back(exported.list.settings[i]);
  }
  return list;
}

/// Whether some texel's centre lies in the part: a piece between texels has no lightmap.
bool covers_a_texel(const Mesh& mesh, const Target& target) {
  std::vector<Vec2> uv;
  for (const std::uint32_t triangle : target.part.triangles) {
    for (std::size_t k = 0; k < 3; ++k)
      uv.push_back((*target.uv)[mesh.triangle_loops[3 * std::size_t(triangle) + k]]);
  }
  const UvRaster raster = rasterize(uv, target.width, target.height);
  for (int y = 0; y < target.height; ++y) {
    for (int x = 0; x < target.width; ++x) {
      if (raster.at(x, y).triangle >= 0) return true;
    }
  }
  return false;
}

std::size_t target_count(const Splitting& splitting) {
  return splitting.list.targets.size();
}

/// Targets of `whole`, each cut into parts by `cut`.
template <typename Cut>
TargetList cut_objects(const SceneSurvey& survey, const TargetList& whole, Cut cut) {
  TargetList list;
  list.skipped = whole.skipped;
  for (std::size_t i = 0; i < whole.targets.size(); ++i) {
    std::vector<Part> parts = cut(whole.targets[i]);
    for (Part& part : parts) {
      Target target = whole.targets[i];
      if (parts.size() > 1) target.key += "/" + part.name;
      if (parts.size() == 1) part.name.clear();
      target.part = std::move(part);
      if (!covers_a_texel(survey.mesh_of(survey.objects[target.object]), target)) continue;
      list.targets.push_back(std::move(target));
      list.settings.push_back(whole.settings[i]);
    }
  }
  return list;
}

struct Box {
  Vec3d low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  void add(const Vec3d& p) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  [[nodiscard]] std::array<int, 3> cell(const Vec3d& p, int cells) const {
    std::array<int, 3> at{};
    for (int axis = 0; axis < 3; ++axis) {
      const double size = high[axis] - low[axis];
      const double share = size > 0 ? (p[axis] - low[axis]) / size : 0;
      at[std::size_t(axis)] = std::clamp(static_cast<int>(share * cells), 0, cells - 1);
    }
    return at;
  }
};

Box bounds_of(const SceneSurvey& survey, const TargetList& whole) {
  Box box;
  for (const Target& target : whole.targets) {
    const SceneObject& object = survey.objects[target.object];
    for (const Vec3& p : survey.mesh_of(object).positions) box.add(Vec3d(p) * object.to_world);
  }
  return box;
}

/// A polygon belongs to the cell of its first triangle's middle: parts are made of whole polygons.
std::vector<Part> cut_by_grid(const SceneSurvey& survey, const Target& target, const Box& box, int cells) {
  const SceneObject& object = survey.objects[target.object];
  const Mesh& mesh = survey.mesh_of(object);
  std::map<std::uint32_t, std::array<int, 3>> cell_of;  // by polygon
  std::map<std::array<int, 3>, Part> parts;
  for (const std::uint32_t t : target.part.triangles) {
    Vec3d middle(0);
    for (std::size_t k = 0; k < 3; ++k)
      middle += Vec3d(mesh.positions[mesh.corner_vertex(3 * std::size_t(t) + k)]) * object.to_world / 3.0;
    const auto& cell =
        cell_of.try_emplace(static_cast<std::uint32_t>(mesh.triangle_polygon[t]), box.cell(middle, cells))
            .first->second;
    Part& part = parts[cell];
    part.name = fmt::format("cell{}-{}-{}", cell[0], cell[1], cell[2]);
    part.triangles.push_back(t);
  }
  std::vector<Part> list;
  list.reserve(parts.size());
  for (auto& [cell, part] : parts) list.push_back(std::move(part));
  return list;
}

/// Relative RMSE over all bases: the root of the mean of the squares.
Statistic over_bases(const std::vector<BasisMetrics>& bases) {
  Statistic sum;
  for (const BasisMetrics& basis : bases) {
    const Statistic& one = basis.metrics.relative_rmse;
    sum.value += one.value * one.value;
    sum.low95 += one.low95 * one.low95;
    sum.high95 += one.high95 * one.high95;
  }
  const double count = double(std::max<std::size_t>(1, bases.size()));
  return {std::sqrt(sum.value / count), std::sqrt(sum.low95 / count), std::sqrt(sum.high95 / count)};
}

}  // namespace

std::vector<Splitting> splittings(const ExportResult& exported) {
  const SceneSurvey& survey = exported.diffuse_scene.survey;
  const TargetList whole = whole_objects(exported);
  const auto by = [&](ObjectSettings::Split mode) {
    return cut_objects(survey, whole, [&](const Target& target) {
      const SceneObject& object = survey.objects[target.object];
      return split_mesh(survey.mesh_of(object), object.slots, mode);
    });
  };
  std::vector<Splitting> all{{"whole", whole},
                             {"material", by(ObjectSettings::Split::material)},
                             {"loose", by(ObjectSettings::Split::loose)}};
  const Box box = bounds_of(survey, whole);
  for (const int cells : {2, 4}) {
    all.push_back({fmt::format("grid {}", cells), cut_objects(survey, whole, [&](const Target& target) {
                     return cut_by_grid(survey, target, box, cells);
                   })});
  }
  std::ranges::stable_sort(all, {}, target_count);
  const auto as_many = [](const Splitting& a, const Splitting& b) {
    return target_count(a) == target_count(b);
  };
  all.erase(std::unique(all.begin(), all.end(), as_many), all.end());
  std::erase_if(all, [](const Splitting& one) {
    const bool too_many = one.name != "whole" && one.list.targets.size() > most_targets;
    if (too_many)
      log::info("the study leaves out '{}': it has {}", one.name, counted(one.list.targets.size(), "target"));
    return too_many;
  });
  return all;
}

StudyPoint study_point(const VariantBase& base, const Splitting& splitting, const ReferencePlan& plan,
                       int seed) {
  std::string name = splitting.name;
  std::ranges::replace(name, ' ', '-');
  const std::filesystem::path folder = std::filesystem::path("study") / name;
  const BakeVariant recipe{BakingSettings::Recipe::flat_normal_map, SceneSettings::Materials::lambert,
                           folder / flat_normal_map_name, seed, true};
  StudyPoint point;
  point.name = splitting.name;
  point.targets = splitting.list.targets.size();
  for (const int half : {0, 1}) {
    point.seconds += bake_half(base, splitting.list, recipe, half).timings.wall_seconds;
  }
  (void)trace_variant(base, splitting.list, {plan, folder / "reference", seed + 2, "tracing"});
  CompareOptions options;
  options.candidate = {half_folder(base, recipe, 0), half_folder(base, recipe, 1), flat_normal_map_name};
  options.reference.path = base.session.settings().output.dir / folder / "reference";
  options.with_maps = false;
  point.error = over_bases(compare_lightmaps(options).scene);
  return point;
}

}  // namespace rnmbake
