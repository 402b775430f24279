// trace/geometry/accelerator.h - Embree's BVH over a scene's triangles. Private to the trace room.
#pragma once

#include "rays/embree_scene.h"
#include "trace/geometry/surface_materials.h"
#include "trace/geometry/triangles.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rnmbake {

/// One geometry of the opaque triangles, and one of the see-through triangles where there are any.
class Accelerator {
 public:
  /// `filter` is called for every hit on a see-through triangle, in both kinds of query. Throws
  /// Error(environment) where Embree fails. The triangles must outlive it and stay where they are in memory.
  Accelerator(Triangles& triangles, const SurfaceMaterials& materials, RTCFilterFunctionN filter);
  Accelerator(const Accelerator&) = delete;
  Accelerator& operator=(const Accelerator&) = delete;

  [[nodiscard]] RTCScene scene() const { return embree_.scene(); }
  [[nodiscard]] bool see_through() const { return !numbers_[1].empty(); }
  /// Index into Triangles of a hit.
  [[nodiscard]] std::uint32_t triangle(std::uint32_t geometry, std::uint32_t primitive) const {
    return see_through() ? numbers_[geometry][primitive] : primitive;
  }
  [[nodiscard]] std::ptrdiff_t bytes() const { return bytes_; }

 private:
  void sort(const Triangles& triangles, const SurfaceMaterials& materials);
  void add(unsigned geometry, const Triangles& triangles, RTCFilterFunctionN filter);
  static bool count_bytes(void* self, ssize_t bytes, bool after);

  // [opaque, see-through]
  std::vector<std::uint32_t> corners_[2];  // indices into Triangles::position
  std::vector<std::uint32_t> numbers_[2];  // of triangles; empty where all are opaque
  std::atomic<std::ptrdiff_t> bytes_ = 0;
  EmbreeScene embree_;  // released first: it reads the corners, and its bytes are counted
};

}  // namespace rnmbake
