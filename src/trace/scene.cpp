#include "trace/scene.h"

#include "base/clock.h"
#include "base/math.h"
#include "trace/geometry/accelerator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace rnmbake {

namespace {

template <typename T>
T interpolated(const std::vector<T>& corners, const Hit& hit) {
  const T* c = &corners[3 * std::size_t(hit.triangle)];
  return c[0] * (1 - hit.b1 - hit.b2) + c[1] * hit.b1 + c[2] * hit.b2;
}

/// Probability of a path to go straight on: the transmittance over all that is not absorbed.
float transmit_probability(const Vec3& transmittance, const Vec3& albedo) {
  const float through = max_channel(transmittance);
  return through > 0 ? through / (through + max_channel(albedo)) : 0;
}

}  // namespace

/// State of a query, which Embree's filter function finds in its context.
struct TraceScene::TransparencyQuery {
  const TraceScene& scene;
  std::vector<TransparentHit>* transparent_hits = nullptr;  // all hits, or ...
  Visibility visibility;                                    // ... their product
  std::vector<float> seams;                                 // distances of hits on edges

  /// A ray along the common edge of two triangles meets both.
  [[nodiscard]] bool is_known(const Hit& hit) {
    if (std::min({hit.b1, hit.b2, 1 - hit.b1 - hit.b2}) > 1e-6F) return false;
    const auto near = [&](float seam) { return std::abs(seam - hit.distance) <= 1e-5F * hit.distance; };
    if (std::any_of(seams.begin(), seams.end(), near)) return true;
    seams.push_back(hit.distance);
    return false;
  }

  /// Whether the ray goes on.
  [[nodiscard]] bool pass(const Hit& hit) {
    const std::uint32_t material = scene.triangles_.material[hit.triangle];
    const Vec2 uv = interpolated(scene.triangles_.uv, hit);
    const Vec3 transmittance = scene.materials_.transmittance(material, uv);
    if (!(max_channel(transmittance) > 0)) return false;
    if (is_known(hit)) return true;
    const float share = transmit_probability(transmittance, scene.materials_.albedo(material, uv));
    if (transparent_hits != nullptr) {
      transparent_hits->push_back({hit, transmittance, share});
    } else {
      visibility.transmittance *= transmittance;
      visibility.transmit_probability *= share;
    }
    return true;
  }

  static void filter(const RTCFilterFunctionNArguments* arguments) {
    auto* query_state = static_cast<TransparencyQuery*>(embree_user(*arguments));
    if (query_state == nullptr || arguments->valid[0] == 0) return;  // as if it were opaque
    const RTCHit at = rtcGetHitFromHitN(arguments->hit, arguments->N, 0);
    const Hit hit{query_state->scene.accelerator_->triangle(at.geomID, at.primID), at.u, at.v,
                  RTCRayN_tfar(arguments->ray, arguments->N, 0), unit(Vec3(at.Ng_x, at.Ng_y, at.Ng_z))};
    if (query_state->pass(hit)) arguments->valid[0] = 0;
  }
};

TraceScene::TraceScene(const DiffuseScene& scene, const std::string& blender_version)
    : diffuse_scene_(scene),
      origin_(middle_of(scene)),
      triangles_(world_triangles(scene, origin_)),
      materials_(scene),
      lights_(scene, triangles_, blender_version, origin_),
      accelerator_(std::make_unique<Accelerator>(triangles_, materials_, &TransparencyQuery::filter)) {}

TraceScene::~TraceScene() = default;

bool TraceScene::intersect(const Ray& ray, Hit& hit, std::vector<TransparentHit>& transparent_hits) const {
  if (log_ != nullptr) log_->add({ray.origin, ray.direction, ray.to, false});
  RTCRayHit query = embree_ray_hit(ray.origin, ray.direction, ray.to);
  if (accelerator_->see_through()) {
    transparent_hits.clear();
    TransparencyQuery query_state{*this, &transparent_hits, {}, {}};
    embree_intersect(accelerator_->scene(), query, &query_state);
    std::erase_if(transparent_hits,
                  [&](const TransparentHit& it) { return it.hit.distance > query.ray.tfar; });
    std::sort(transparent_hits.begin(), transparent_hits.end(),
              [](const TransparentHit& a, const TransparentHit& b) {
                return std::pair(a.hit.distance, a.hit.triangle) < std::pair(b.hit.distance, b.hit.triangle);
              });
  } else {
    embree_intersect(accelerator_->scene(), query);
  }
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  hit.triangle = accelerator_->triangle(query.hit.geomID, query.hit.primID);
  hit.b1 = query.hit.u;
  hit.b2 = query.hit.v;
  hit.distance = query.ray.tfar;
  hit.normal = unit(Vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z));
  return true;
}

Visibility TraceScene::visibility(const Ray& ray) const {
  if (log_ != nullptr) log_->add({ray.origin, ray.direction, ray.to, true});
  RTCRay query = embree_ray(ray.origin, ray.direction, ray.to);
  TransparencyQuery query_state{*this, nullptr, {}, {}};
  if (accelerator_->see_through()) {
    embree_occluded(accelerator_->scene(), query, &query_state);
  } else {
    embree_occluded(accelerator_->scene(), query);
  }
  return query.tfar < 0 ? Visibility{Vec3(0), 0} : query_state.visibility;
}

std::vector<Vec3> TraceScene::relative(std::span<const Vec3d> places) const {
  std::vector<Vec3> found;
  found.reserve(places.size());
  for (const Vec3d& place : places) found.emplace_back(place - origin_);
  return found;
}

void TraceScene::visibility(std::span<const Ray> rays, Visibility* results) const {
  if (rays.size() == 1 || accelerator_->see_through()) {
    for (const Ray& ray : rays) *results++ = visibility(ray);
    return;
  }
  alignas(32) RTCRay8 query;
  alignas(32) std::array<int, packet> valid{};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Ray& ray = rays[i];
    if (log_ != nullptr) log_->add({ray.origin, ray.direction, ray.to, true});
    valid[i] = -1;
    query.org_x[i] = ray.origin.x;
    query.org_y[i] = ray.origin.y;
    query.org_z[i] = ray.origin.z;
    query.dir_x[i] = ray.direction.x;
    query.dir_y[i] = ray.direction.y;
    query.dir_z[i] = ray.direction.z;
    query.tnear[i] = 0;
    query.tfar[i] = ray.to;
    query.time[i] = 0;
    query.mask[i] = all_rays;
    query.flags[i] = 0;
  }
  embree_occluded8(valid.data(), accelerator_->scene(), query);
  for (std::size_t i = 0; i < rays.size(); ++i)
    results[i] = query.tfar[i] < 0 ? Visibility{Vec3(0), 0} : Visibility{};
}

double TraceScene::time_bare(const RayLog& log, int threads) const {
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  RTCScene tree = accelerator_->scene();
  const bool see_through = accelerator_->see_through();
  const auto pass = [&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, log.size(), 4096), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        RTCRayHit query = embree_ray_hit(log[i].origin, log[i].direction, log[i].to);
        if (log[i].shadow) {
          see_through ? embree_occluded(tree, query.ray, nullptr) : embree_occluded(tree, query.ray);
        } else {
          see_through ? embree_intersect(tree, query, nullptr) : embree_intersect(tree, query);
        }
      }
    });
  };
  arena.execute(pass);  // warms the caches
  constexpr int passes = 3;
  const double start = steady_clock().now();
  for (int i = 0; i < passes; ++i) arena.execute(pass);
  return passes * double(log.size()) / (steady_clock().now() - start);
}

std::size_t TraceScene::bytes() const {
  const std::size_t for_each = 3 * (2 * sizeof(Vec3) + sizeof(Vec2)) + 6 * sizeof(std::uint32_t);
  return triangles_.size() * for_each + static_cast<std::size_t>(accelerator_->bytes());
}

Vec2 picture_uv(const TraceScene& scene, const Hit& hit) {
  return interpolated(scene.triangles().uv, hit);
}

Vertex vertex_at(const TraceScene& scene, const Ray& ray, const Hit& hit) {
  const Triangles& triangles = scene.triangles();
  Vertex vertex;
  vertex.position = interpolated(triangles.position, hit);
  vertex.back = hit.normal.dot(ray.direction) > 0;
  vertex.face = vertex.back ? -hit.normal : hit.normal;
  const Vec3 smooth = interpolated(triangles.normal, hit);
  const float length = smooth.length();
  vertex.normal = length > 0 ? smooth / (vertex.back ? -length : length) : vertex.face;
  const Vec3* corners = &triangles.position[3 * std::size_t(hit.triangle)];
  vertex.ray_offset =
      std::max({ray_offset_at(corners[0]), ray_offset_at(corners[1]), ray_offset_at(corners[2])});
  vertex.wo = -ray.direction;
  vertex.b1 = hit.b1;
  vertex.b2 = hit.b2;
  vertex.uv = picture_uv(scene, hit);
  vertex.triangle = hit.triangle;
  vertex.material = triangles.material[hit.triangle];
  return vertex;
}

}  // namespace rnmbake
