// pipeline/deliver/engines/unreal_names.h - what Unreal makes of the names in a .glb.
#pragma once

#include "pipeline/deliver/glb_nodes.h"

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace rnmbake {

/// What names of objects and packages cannot hold (spaces, dots, most punctuation) becomes underscores.
[[nodiscard]] std::string unreal_name(std::string_view name);

/// Names of Unreal know no case: engines/unreal/rnmbake_unreal.py finds actors without it.
class UnrealNames {
 public:
  explicit UnrealNames(const GlbNodes& nodes);

  /// Throws Error(unsupported), naming both, where the node shares its name with another.
  void check(std::size_t node) const;

 private:
  std::multimap<std::string, std::size_t> nodes_by_name_;
  const GlbNodes& nodes_;
};

}  // namespace rnmbake
