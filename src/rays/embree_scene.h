// rays/embree_scene.h - a device with one scene, built whole or with a word about why not.
#pragma once

#include "base/math.h"
#include "rays/embree.h"

#include <cstddef>
#include <cstdint>

namespace rnmbake {

class EmbreeScene {
 public:
  /// Throws Error(environment) where Embree does not start.
  EmbreeScene();
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  [[nodiscard]] RTCDevice device() const { return device_; }
  [[nodiscard]] RTCScene scene() const { return scene_; }

  /// Embree's own memory, to be filled.
  struct Mesh {
    RTCGeometry geometry = nullptr;
    Vec3* points = nullptr;
    std::uint32_t* corners = nullptr;  // three for each triangle
  };
  /// It must be attached. Throws Error(environment) where memory does not suffice.
  [[nodiscard]] Mesh new_mesh(std::size_t points, std::size_t triangles) const;

  /// Puts a mesh into the scene, seen by all rays, and keeps it.
  void attach(RTCGeometry mesh, unsigned number) const;

  /// Throws Error(environment) where anything since the start has failed.
  void build(std::size_t triangles) const;

 private:
  [[noreturn]] static void fail_to_build(std::size_t triangles, RTCError error);

  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

}  // namespace rnmbake
