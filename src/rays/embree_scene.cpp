#include "rays/embree_scene.h"

#include "base/error.h"

namespace rnmbake {

EmbreeScene::EmbreeScene() : device_(rtcNewDevice(nullptr)) {
  if (device_ == nullptr) {
    fail(ExitCode::environment, "Embree does not start (error {}): is this processor older than SSE2?",
         static_cast<int>(rtcGetDeviceError(nullptr)));
  }
  scene_ = rtcNewScene(device_);
}

EmbreeScene::~EmbreeScene() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

EmbreeScene::Mesh EmbreeScene::new_mesh(std::size_t points, std::size_t triangles) const {
  Mesh mesh{rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE)};
  mesh.points = static_cast<Vec3*>(rtcSetNewGeometryBuffer(mesh.geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                           RTC_FORMAT_FLOAT3, sizeof(Vec3), points));
  mesh.corners = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      mesh.geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), triangles));
  if (mesh.points == nullptr || mesh.corners == nullptr) {
    rtcReleaseGeometry(mesh.geometry);
    fail_to_build(triangles, rtcGetDeviceError(device_));
  }
  return mesh;
}

void EmbreeScene::attach(RTCGeometry mesh, unsigned number) const {
  rtcSetGeometryMask(mesh, all_rays);
  rtcCommitGeometry(mesh);
  rtcAttachGeometryByID(scene_, mesh, number);
  rtcReleaseGeometry(mesh);
}

void EmbreeScene::build(std::size_t triangles) const {
  rtcCommitScene(scene_);
  if (const RTCError error = rtcGetDeviceError(device_); error != RTC_ERROR_NONE)
    fail_to_build(triangles, error);
}

void EmbreeScene::fail_to_build(std::size_t triangles, RTCError error) {
  fail(ExitCode::environment,
       "Embree could not build its tree over {} triangles (error {}): is there memory?", triangles,
       static_cast<int>(error));
}

}  // namespace rnmbake
