#include "ssbump/triangle_tree.h"

#include "base/error.h"
#include "rays/embree.h"

#include <algorithm>
#include <numeric>

namespace rnmbake {
namespace {

void aim(RTCRay& ray, const Vec3& origin, const Vec3& direction, float near, float far) {
  ray = {};
  ray.org_x = origin.x;
  ray.org_y = origin.y;
  ray.org_z = origin.z;
  ray.dir_x = direction.x;
  ray.dir_y = direction.y;
  ray.dir_z = direction.z;
  ray.tnear = near;
  ray.tfar = far;
  ray.mask = all_rays;
}

}  // namespace

struct TriangleTree::Handles {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = nullptr;

  Handles() = default;
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;
  ~Handles() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  void add(const std::vector<Vec3>& corners) {
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<Vec3*>(rtcSetNewGeometryBuffer(
        mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3), corners.size()));
    auto* numbers = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), corners.size() / 3));
    if (points != nullptr && numbers != nullptr) {
      std::copy(corners.begin(), corners.end(), points);
      std::iota(numbers, numbers + corners.size(), 0U);
      rtcSetGeometryMask(mesh, all_rays);
      rtcCommitGeometry(mesh);
      rtcAttachGeometryByID(scene, mesh, 0);
    }
    rtcReleaseGeometry(mesh);
  }
};

TriangleTree::TriangleTree(const std::vector<Vec3>& corners) : handles_(std::make_unique<Handles>()) {
  if (handles_->device == nullptr) {
    fail(ExitCode::environment, "Embree does not start (error {}): is this processor older than SSE2?",
         static_cast<int>(rtcGetDeviceError(nullptr)));
  }
  handles_->scene = rtcNewScene(handles_->device);
  rtcSetSceneFlags(handles_->scene, RTC_SCENE_FLAG_ROBUST);  // rays that meet a vertex must not slip through
  if (!corners.empty()) handles_->add(corners);
  rtcCommitScene(handles_->scene);
  if (const RTCError error = rtcGetDeviceError(handles_->device); error != RTC_ERROR_NONE) {
    fail(ExitCode::environment,
         "Embree could not build its tree over {} triangles (error {}): is there memory?", corners.size() / 3,
         static_cast<int>(error));
  }
}

TriangleTree::~TriangleTree() = default;

std::optional<TriangleHit> TriangleTree::first(const Vec3& origin, const Vec3& direction, float near,
                                               float far) const {
  RTCRayHit query{};
  aim(query.ray, origin, direction, near, far);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  embree_intersect(handles_->scene, query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return TriangleHit{query.hit.primID, query.ray.tfar, query.hit.u, query.hit.v};
}

bool TriangleTree::blocked(const Vec3& origin, const Vec3& direction, float far) const {
  RTCRay ray;
  aim(ray, origin, direction, 0, far);
  embree_occluded(handles_->scene, ray);
  return ray.tfar < 0;
}

}  // namespace rnmbake
