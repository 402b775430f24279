// pipeline/deliver/glb_nodes.h - what importers make of a .glb's tree of nodes: names, places, extents.
#pragma once

#include "base/math.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <ImathBox.h>
#include <nlohmann/json.hpp>

namespace rnmbake {

/// Of a file that Blender's exporter wrote. Space: the file's own, y upwards, metres.
class GlbNodes {
 public:
  /// Throws Error(io), Error(invalid_input) naming the file.
  explicit GlbNodes(const std::filesystem::path& file);

  [[nodiscard]] std::size_t size() const { return nodes_.size(); }
  [[nodiscard]] std::string name(std::size_t node) const;

  /// From a node of the scene down to `node` itself.
  [[nodiscard]] std::vector<std::size_t> path(std::size_t node) const;

  /// Of the node's mesh, in the world; empty without one.
  [[nodiscard]] Imath::Box3d bounds(std::size_t node) const;

  [[nodiscard]] std::string scene_name() const;
  [[nodiscard]] std::vector<std::string> mesh_names() const;

 private:
  [[nodiscard]] Mat44 to_world(std::size_t node) const;

  nlohmann::json gltf_, nodes_;
  std::vector<int> parents_;  // -1: none
};

}  // namespace rnmbake
