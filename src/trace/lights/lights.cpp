#include "trace/lights/lights.h"

#include "base/math.h"
#include "sampling/maps.h"
#include "trace/geometry/surface_materials.h"
#include "trace/lights/emissive_triangle.h"
#include "trace/lights/lamp.h"
#include "trace/lights/light_bounds.h"
#include "trace/lights/light_tree.h"
#include "trace/lights/light_units.h"
#include "trace/lights/world_light.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace rnmbake {
namespace {

constexpr std::uint32_t not_emissive = ~std::uint32_t(0);
constexpr float even_share = 0.2F;     // of the choice is uniform: a dim group may be the only one visible
constexpr float horizon_share = 0.3F;  // as in the light tree

/// Irradiance of a sun, softened towards the horizon; 0 where all of it is below.
float sun_importance(const Lamp& sun, const Vec3& normal) {
  const float slant2 = 1 + sun.radius * sun.radius;
  const float irradiance =
      mean_magnitude(sun.radiance) * (sun.radius > 0 ? pi_f * sun.radius * sun.radius / slant2 : 1.0F);
  if (normal == Vec3(0, 0, 0)) return irradiance;
  const float along = -sun.axis.dot(normal);
  if (along < -1e-3F - sun.radius / std::sqrt(slant2)) return 0;
  return irradiance * (horizon_share + (1 - horizon_share) * std::max(along, 0.0F));
}

}  // namespace

/// The groups that a sample chooses from: the tree, the world, the suns.
struct Lights::Impl {
  Impl(const DiffuseScene& diffuse_scene, const Triangles& all, const std::string& blender_version,
       const Vec3d& origin)
      : triangles(all),
        materials(diffuse_scene),
        world(diffuse_scene),
        emissive_triangles(find_emissive_triangles(diffuse_scene, all)) {
    for (Lamp& lamp : read_lamps(diffuse_scene.survey, blender_version, origin)) {
      (lamp.kind == Lamp::Kind::sun ? suns : lamps).push_back(lamp);
    }
    std::vector<LightBounds> bounds;
    for (const Lamp& lamp : lamps) bounds.push_back(lamp_bounds(lamp));
    emissive_triangle_of.assign(emissive_triangles.empty() ? 0 : all.size(), not_emissive);
    for (std::size_t i = 0; i < emissive_triangles.size(); ++i) {
      bounds.push_back(emissive_triangle_bounds(emissive_triangles[i]));
      emissive_triangle_of[emissive_triangles[i].triangle] = static_cast<std::uint32_t>(i);
    }
    tree = LightTree(bounds);
  }

  /// Importance of each group, and the number of groups that have any.
  struct Weights {
    float tree = 0, world = 0, suns = 0, sum = 0;
    int groups = 0;
    [[nodiscard]] float share(float weight) const {
      return weight > 0 ? (1 - even_share) * weight / sum + even_share / static_cast<float>(groups) : 0.0F;
    }
  };

  [[nodiscard]] Weights weigh(const Vec3& point, const Vec3& normal) const {
    Weights weights;
    if (only_one()) {  // whatever its importance
      weights.tree = tree.empty() ? 0.0F : 1.0F;
      weights.world = world.black() ? 0.0F : 1.0F;
      weights.suns = suns.empty() ? 0.0F : 1.0F;
    } else {
      weights.tree = tree.importance(point, normal);
      weights.world = world.average() * pi_f;
      for (const Lamp& sun : suns) weights.suns += sun_importance(sun, normal);
    }
    weights.sum = weights.tree + weights.world + weights.suns;
    weights.groups = (weights.tree > 0) + (weights.world > 0) + (weights.suns > 0);
    return weights;
  }

  [[nodiscard]] bool only_one() const {
    return int(!tree.empty()) + int(!world.black()) + int(!suns.empty()) == 1;
  }

  [[nodiscard]] LightSample sample_tree(const Vec3& point, const Vec3& normal, const Vec2& on_light,
                                        float u) const {
    const LightTree::Choice choice = tree.choose(point, normal, u);
    if (choice.probability == 0) return {};
    LightSample sample =
        choice.light < lamps.size()
            ? sample_lamp(lamps[choice.light], point, on_light)
            : sample_emissive_triangle(emissive_triangles[choice.light - lamps.size()], point, on_light);
    sample.pdf *= choice.probability;
    return sample;
  }

  [[nodiscard]] LightSample sample_emissive_triangle(const EmissiveTriangle& emitter, const Vec3& point,
                                                     const Vec2& u) const {
    const LightTriangle::Sample on_light = emitter.shape.sample(point, u);
    if (on_light.pdf == 0) return {};
    LightSample sample;
    sample.direction = on_light.direction;
    sample.distance = on_light.distance;
    sample.pdf = on_light.pdf;
    sample.bsdf_can_hit = true;
    const Vec2* uv = &triangles.uv[3 * std::size_t(emitter.triangle)];
    sample.radiance = materials.emission(
        triangles.material[emitter.triangle],
        uv[0] * (1 - on_light.b1 - on_light.b2) + uv[1] * on_light.b1 + uv[2] * on_light.b2);
    return sample;
  }

  [[nodiscard]] LightSample sample_suns(const Vec3& normal, const Vec2& on_light, float u) const {
    float sum = 0;
    for (const Lamp& sun : suns) sum += sun_importance(sun, normal);
    float below = 0;
    for (const Lamp& sun : suns) {
      const float share = sun_importance(sun, normal) / sum;
      below += share;
      if (share == 0 || (u >= below && &sun != &suns.back())) continue;
      LightSample sample = sample_lamp(sun, Vec3(0, 0, 0), on_light);
      sample.pdf *= share;
      return sample;
    }
    return {};
  }

  const Triangles& triangles;
  SurfaceMaterials materials;
  WorldLight world;
  std::vector<EmissiveTriangle> emissive_triangles;
  std::vector<std::uint32_t>
      emissive_triangle_of;  // [triangles] -> emissive_triangles; empty where nothing emits
  std::vector<Lamp> lamps, suns;
  LightTree tree;  // of lamps, then emissive_triangles
};

Lights::Lights(const DiffuseScene& scene, const Triangles& triangles, const std::string& blender_version,
               const Vec3d& origin)
    : impl_(std::make_unique<Impl>(scene, triangles, blender_version, origin)) {}
Lights::~Lights() = default;
Lights::Lights(Lights&&) noexcept = default;
Lights& Lights::operator=(Lights&&) noexcept = default;

bool Lights::empty() const {
  return impl_->tree.empty() && impl_->suns.empty() && impl_->world.black();
}

LightSample Lights::sample(const Vec3& point, const Vec3& normal, const Vec3& u) const {
  const Impl::Weights weights = impl_->weigh(point, normal);
  if (weights.groups == 0) return {};
  const Vec2 on_light(u.y, u.z);
  const float tree = weights.share(weights.tree), world = weights.share(weights.world);
  const auto within = [&](float from, float width) {
    return std::clamp((u.x - from) / width, 0.0F, 0.99999994F);
  };
  LightSample sample;
  float probability = tree;
  if (u.x < tree) {
    sample = impl_->sample_tree(point, normal, on_light, within(0, tree));
  } else if (u.x < tree + world || weights.suns == 0) {
    if (world == 0) return {};  // rounding ran past the tree
    sample = impl_->world.sample(normal, on_light, within(tree, world));
    probability = world;
  } else {
    probability = weights.share(weights.suns);
    sample = impl_->sample_suns(normal, on_light, within(tree + world, probability));
  }
  sample.pdf *= probability;
  return sample;
}

Vec3 Lights::world(const Vec3& direction) const {
  return impl_->world.radiance(direction);
}

bool Lights::world_is_even() const {
  return impl_->world.even();
}

float Lights::world_pdf(const Vec3& point, const Vec3& normal, const Vec3& direction) const {
  if (impl_->world.black()) return 0;
  const Impl::Weights weights = impl_->weigh(point, normal);
  return weights.share(weights.world) * impl_->world.pdf(normal, direction);
}

float Lights::triangle_pdf(const Vec3& point, const Vec3& normal, std::uint32_t triangle,
                           const Vec3& direction, float distance) const {
  if (impl_->emissive_triangle_of.empty() || impl_->emissive_triangle_of[triangle] == not_emissive) return 0;
  const std::uint32_t emitter = impl_->emissive_triangle_of[triangle];
  const auto light = static_cast<std::uint32_t>(impl_->lamps.size()) + emitter;
  const float choice = impl_->tree.probability(point, normal, light);
  if (choice == 0) return 0;
  const Impl::Weights weights = impl_->weigh(point, normal);
  return weights.share(weights.tree) * choice *
         impl_->emissive_triangles[emitter].shape.pdf(point, direction, distance);
}

}  // namespace rnmbake
