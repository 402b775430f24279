#include "trace/scene.h"

#include "base/clock.h"
#include "base/error.h"
#include "rays/embree.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace rnmbake {

/// One mesh of all triangles. Embree reads the positions where they are and up to 16 bytes past them.
struct TraceScene::Accelerator {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<std::uint32_t> corners;
  std::atomic<std::ptrdiff_t> bytes = 0;

  explicit Accelerator(Triangles& triangles) : corners(triangles.position.size()) {
    std::iota(corners.begin(), corners.end(), 0U);
    triangles.position.reserve(triangles.position.size() + 2);
    device = rtcNewDevice(nullptr);
    if (device == nullptr) {
      fail(ExitCode::environment, "Embree does not start (error {}): is this processor older than SSE2?",
           static_cast<int>(rtcGetDeviceError(nullptr)));
    }
    rtcSetDeviceMemoryMonitorFunction(device, count_bytes, this);
    scene = rtcNewScene(device);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    if (triangles.size() > 0) add(triangles);
    rtcCommitScene(scene);
    if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE) {
      fail(ExitCode::environment,
           "Embree could not build its tree over {} triangles (error {}): is there memory?", triangles.size(),
           static_cast<int>(error));
    }
  }
  ~Accelerator() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
  Accelerator(const Accelerator&) = delete;
  Accelerator& operator=(const Accelerator&) = delete;

 private:
  void add(const Triangles& triangles) {
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, triangles.position.data(),
                               0, sizeof(Vec3), triangles.position.size());
    rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, corners.data(), 0,
                               3 * sizeof(std::uint32_t), triangles.size());
    rtcSetGeometryMask(mesh, all_rays);
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene, mesh);
    rtcReleaseGeometry(mesh);
  }

  static bool count_bytes(void* self, ssize_t bytes, bool /*after*/) {
    static_cast<Accelerator*>(self)->bytes += bytes;
    return true;
  }
};

namespace {

RTCRay to_embree(const Ray& ray) {
  RTCRay out{};
  out.org_x = ray.origin.x;
  out.org_y = ray.origin.y;
  out.org_z = ray.origin.z;
  out.dir_x = ray.direction.x;
  out.dir_y = ray.direction.y;
  out.dir_z = ray.direction.z;
  out.tfar = ray.to;
  out.mask = all_rays;
  return out;
}

RTCRayHit ask_embree(const Ray& ray) {
  RTCRayHit query;
  query.ray = to_embree(ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

template <typename T>
T mixed(const std::vector<T>& corners, const Hit& hit) {
  const T* c = &corners[3 * std::size_t(hit.triangle)];
  return c[0] * (1 - hit.b1 - hit.b2) + c[1] * hit.b1 + c[2] * hit.b2;
}

}  // namespace

TraceScene::TraceScene(const Exchange& scene, const std::string& blender_version)
    : exchange_(scene),
      triangles_(world_triangles(scene)),
      looks_(scene),
      lights_(scene, triangles_, blender_version),
      accelerator_(std::make_unique<Accelerator>(triangles_)) {}

TraceScene::~TraceScene() = default;

bool TraceScene::intersect(const Ray& ray, Hit& hit) const {
  if (log_ != nullptr) log_->add({ray.origin, ray.direction, ray.to, false});
  RTCRayHit query = ask_embree(ray);
  embree_intersect(accelerator_->scene, query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  hit.triangle = query.hit.primID;
  hit.b1 = query.hit.u;
  hit.b2 = query.hit.v;
  hit.distance = query.ray.tfar;
  hit.normal = unit(Vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z));
  return true;
}

bool TraceScene::occluded(const Ray& ray) const {
  if (log_ != nullptr) log_->add({ray.origin, ray.direction, ray.to, true});
  RTCRay query = to_embree(ray);
  embree_occluded(accelerator_->scene, query);
  return query.tfar < 0;
}

unsigned TraceScene::occluded(std::span<const Ray> rays) const {
  if (rays.size() == 1) return occluded(rays[0]) ? 1 : 0;
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
  embree_occluded8(valid.data(), accelerator_->scene, query);
  unsigned blocked = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) blocked |= (query.tfar[i] < 0 ? 1U : 0U) << i;
  return blocked;
}

double TraceScene::time_bare(const RayLog& log, int threads) const {
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  const auto pass = [&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, log.size(), 4096), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        RTCRayHit query = ask_embree({log[i].origin, log[i].direction, log[i].to});
        if (log[i].shadow) {
          embree_occluded(accelerator_->scene, query.ray);
        } else {
          embree_intersect(accelerator_->scene, query);
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
  return triangles_.size() * for_each + static_cast<std::size_t>(accelerator_->bytes.load());
}

Vertex vertex_at(const TraceScene& scene, const Ray& ray, const Hit& hit) {
  const Triangles& triangles = scene.triangles();
  Vertex vertex;
  vertex.position = mixed(triangles.position, hit);
  vertex.back = hit.normal.dot(ray.direction) > 0;
  vertex.face = vertex.back ? -hit.normal : hit.normal;
  const Vec3 smooth = mixed(triangles.normal, hit);
  const float length = smooth.length();
  vertex.normal = length > 0 ? smooth / (vertex.back ? -length : length) : vertex.face;
  const Vec3* corners = &triangles.position[3 * std::size_t(hit.triangle)];
  vertex.gap = std::max({rounding_gap(corners[0]), rounding_gap(corners[1]), rounding_gap(corners[2])});
  vertex.towards = -ray.direction;
  vertex.b1 = hit.b1;
  vertex.b2 = hit.b2;
  vertex.uv = mixed(triangles.uv, hit);
  vertex.triangle = hit.triangle;
  vertex.look = triangles.look[hit.triangle];
  return vertex;
}

}  // namespace rnmbake
