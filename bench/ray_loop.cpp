#include "ray_loop.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <tbb/parallel_for.h>

namespace rnmbake {
namespace {

constexpr int lanes = 8;
constexpr float lift = 1.0F / 1024;  // texels that rays begin over the surface
constexpr float far = std::numeric_limits<float>::infinity();
constexpr std::size_t channel_count = SsbumpWeights::channels;

void aim(RTCRay8& query, const Vec3& direction) {
  for (int lane = 0; lane < lanes; ++lane) {
    query.dir_x[lane] = direction.x;
    query.dir_y[lane] = direction.y;
    query.dir_z[lane] = direction.z;
    query.tnear[lane] = query.time[lane] = 0;
    query.tfar[lane] = far;
    query.mask[lane] = all_rays;
    query.flags[lane] = 0;
  }
}

}  // namespace

/// The texels of a square, side by side: where their rays begin, and what they have seen.
struct RayLoop::Square {
  static constexpr int texels = tile * tile;
  std::array<float, texels> x, y, z;
  std::array<std::array<float, texels>, channel_count> seen{};

  void trace_eights(RTCScene scene, const WeightedRay& ray) {
    alignas(32) static constexpr std::array<int, lanes> all{-1, -1, -1, -1, -1, -1, -1, -1};
    RTCRay8 query;
    for (int first = 0; first < texels; first += lanes) {
      aim(query, ray.direction);
      const auto at = static_cast<std::size_t>(first);
      std::copy_n(&x[at], lanes, query.org_x);
      std::copy_n(&y[at], lanes, query.org_y);
      std::copy_n(&z[at], lanes, query.org_z);
      embree_occluded8(all.data(), scene, query);
      for (std::size_t c = 0; c < channel_count; ++c) {
        for (std::size_t lane = 0; lane < lanes; ++lane)
          seen[c][at + lane] += query.tfar[lane] > 0 ? ray.weight[c] : 0.0F;
      }
    }
  }

  void trace_ones(RTCScene scene, const WeightedRay& ray) {
    RTCRay query = embree_ray(Vec3(0), ray.direction, far);
    for (std::size_t i = 0; i < texels; ++i) {
      query.org_x = x[i];
      query.org_y = y[i];
      query.org_z = z[i];
      query.tfar = far;
      embree_occluded(scene, query);
      if (query.tfar < 0) continue;
      for (std::size_t c = 0; c < channel_count; ++c) seen[c][i] += ray.weight[c];
    }
  }
};

RayLoop::RayLoop(const HeightField& field, int margin) : field_(field) {
  if (field.width() % tile != 0 || field.height() % tile != 0)
    fail(ExitCode::usage, "the map's sides must be multiples of {}", int{tile});
  rtcSetSceneBuildQuality(embree_.scene(), RTC_BUILD_QUALITY_HIGH);
  build(margin);
}

/// The map's middle is the origin: single precision is best there.
Vec3 RayLoop::origin(int x, int y) const {
  const int width = field_.width(), height = field_.height();
  const float at = field_.heights.texel(texel_beyond(x, width, WrapMode::wrap),
                                        texel_beyond(y, height, WrapMode::wrap))[0];
  return {static_cast<float>(x - width / 2), static_cast<float>(height / 2 - y), at};
}

void RayLoop::build(int margin) {
  const int across = field_.width() + 2 * margin + 1, down = field_.height() + 2 * margin + 1;
  const std::size_t triangles = 2 * std::size_t(across - 1) * (down - 1);
  const EmbreeScene::Mesh mesh = embree_.new_mesh(std::size_t(across) * down, triangles);
  auto* points = mesh.points;
  auto* corners = mesh.corners;
  for (int y = 0; y < down; ++y) {
    for (int x = 0; x < across; ++x) *points++ = origin(x - margin, y - margin);
  }
  for (int y = 0; y + 1 < down; ++y) {
    for (int x = 0; x + 1 < across; ++x) {
      const auto a = static_cast<std::uint32_t>(y * across + x), b = a + static_cast<std::uint32_t>(across);
      for (const std::uint32_t corner : {a, b, a + 1, a + 1, b, b + 1}) *corners++ = corner;
    }
  }
  rtcSetGeometryBuildQuality(mesh.geometry, RTC_BUILD_QUALITY_HIGH);
  embree_.attach(mesh.geometry, 0);
  embree_.build(triangles);
}

void RayLoop::trace_square(int x, int y, const HemisphereRays& rays, Packet packet,
                           SsbumpWeights& weights) const {
  const int column = x / tile, row = y / tile;
  const auto number = static_cast<std::uint64_t>(row * tiles_across() + column);
  Square square;
  for (int i = 0; i < Square::texels; ++i) {
    const Vec3 from = origin(column * tile + i % tile, row * tile + i / tile);
    const auto at = static_cast<std::size_t>(i);
    square.x[at] = from.x;
    square.y[at] = from.y;
    square.z[at] = from.z + lift;
  }
  std::array<float, channel_count> whole{};
  for (const WeightedRay& ray : rays.set(number)) {
    for (std::size_t c = 0; c < channel_count; ++c) whole[c] += ray.weight[c];
    packet == Packet::eight ? square.trace_eights(embree_.scene(), ray)
                            : square.trace_ones(embree_.scene(), ray);
  }
  for (int i = 0; i < Square::texels; ++i) {
    const auto texel = weights.image.texel(column * tile + i % tile, row * tile + i / tile);
    for (std::size_t c = 0; c < channel_count; ++c)
      texel[c] = square.seen[c][static_cast<std::size_t>(i)] / whole[c];
  }
}

void RayLoop::trace_row(int tile_row, const HemisphereRays& rays, Packet packet,
                        SsbumpWeights& weights) const {
  tbb::parallel_for(0, tiles_across(),
                    [&](int column) { trace_square(column * tile, tile_row * tile, rays, packet, weights); });
}

std::array<double, channel_count> RayLoop::texel(int x, int y, const std::vector<WeightedRay>& rays) const {
  const Vec3 from = origin(x, y) + Vec3(0, 0, lift);
  std::array<double, channel_count> seen{}, whole{};
  for (const WeightedRay& ray : rays) {
    RTCRay query = embree_ray(from, ray.direction, far);
    embree_occluded(embree_.scene(), query);
    for (std::size_t c = 0; c < channel_count; ++c) {
      whole[c] += double{ray.weight[c]};
      if (query.tfar > 0) seen[c] += double{ray.weight[c]};
    }
  }
  for (std::size_t c = 0; c < channel_count; ++c) seen[c] /= whole[c];
  return seen;
}

}  // namespace rnmbake
