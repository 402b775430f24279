#include "trace/geometry/accelerator.h"

#include <algorithm>
#include <numeric>

namespace rnmbake {

Accelerator::Accelerator(Triangles& triangles, const SurfaceMaterials& materials, RTCFilterFunctionN filter) {
  sort(triangles, materials);
  triangles.position.reserve(triangles.position.size() + 2);  // Embree reads up to 16 bytes past them
  rtcSetDeviceMemoryMonitorFunction(embree_.device(), count_bytes, this);
  rtcSetSceneBuildQuality(scene(), RTC_BUILD_QUALITY_MEDIUM);
  add(0, triangles, nullptr);
  add(1, triangles, filter);
  embree_.build(triangles.size());
}

void Accelerator::sort(const Triangles& triangles, const SurfaceMaterials& materials) {
  const auto lets_through = [&](std::uint32_t material) { return materials.see_through(material); };
  if (std::none_of(triangles.material.begin(), triangles.material.end(), lets_through)) {
    corners_[0].resize(triangles.position.size());
    std::iota(corners_[0].begin(), corners_[0].end(), 0U);
    return;
  }
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const std::size_t kind = lets_through(triangles.material[t]) ? 1 : 0;
    numbers_[kind].push_back(t);
    for (std::uint32_t k = 0; k < 3; ++k) corners_[kind].push_back(3 * t + k);
  }
}

void Accelerator::add(unsigned geometry, const Triangles& triangles, RTCFilterFunctionN filter) {
  const std::vector<std::uint32_t>& corners = corners_[geometry];
  if (corners.empty()) return;
  RTCGeometry mesh = rtcNewGeometry(embree_.device(), RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, triangles.position.data(), 0,
                             sizeof(Vec3), triangles.position.size());
  rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, corners.data(), 0,
                             3 * sizeof(std::uint32_t), corners.size() / 3);
  if (filter != nullptr) {
    rtcSetGeometryIntersectFilterFunction(mesh, filter);
    rtcSetGeometryOccludedFilterFunction(mesh, filter);
  }
  embree_.attach(mesh, geometry);
}

bool Accelerator::count_bytes(void* self, ssize_t bytes, bool /*after*/) {
  static_cast<Accelerator*>(self)->bytes_ += bytes;
  return true;
}

}  // namespace rnmbake
