// pipeline/deliver/engines/godot_names.h - what Godot calls the nodes of a .glb that it imports.
#pragma once

#include "pipeline/deliver/glb_nodes.h"

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace rnmbake {

/// The characters . : @ / " % become underscores.
[[nodiscard]] std::string godot_name(std::string_view name);

/// Godot gives a number to what has the name of something before it: the scene, its meshes as SCENE_MESH, and
/// nodes.
class GodotNames {
 public:
  explicit GodotNames(const GlbNodes& nodes);

  /// From the scene's root. Throws Error(unsupported), naming both, where the node or one above it shares its
  /// name with something else.
  [[nodiscard]] std::string path(std::size_t node) const;

 private:
  const GlbNodes& nodes_;
  std::multimap<std::string, std::string> taken_;  // what has the name, in words
};

}  // namespace rnmbake
