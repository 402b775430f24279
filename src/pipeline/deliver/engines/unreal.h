// pipeline/deliver/engines/unreal.h - Unreal: pages as textures, and a script for its editor that makes
// materials of them.
#pragma once

#include "pipeline/deliver/engine_target.h"

namespace rnmbake {

class Unreal final : public EngineTarget {
 public:
  [[nodiscard]] const char* name() const override { return "unreal"; }

  /// Those of three.js, whose decoders a custom node holds, and flat.
  [[nodiscard]] const std::vector<std::string>& encodings() const override;

  /// pageN_LAYER.exr, half floats: Unreal names assets after files, and no dot can be in them.
  [[nodiscard]] nlohmann::ordered_json write_page(DeliveryFiles& files, std::size_t number,
                                                  Page page) const override;

  /// The script, and its decoder in the record. Throws Error(unsupported) where Unreal makes one name of
  /// those of a lit object and another.
  void add_files(DeliveryFiles& files, nlohmann::ordered_json& record) const override;
};

}  // namespace rnmbake
