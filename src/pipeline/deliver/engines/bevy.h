// pipeline/deliver/engines/bevy.h - Bevy: flat pages, and a Rust module that gives them to the nodes of the
// .glb.
#pragma once

#include "pipeline/deliver/engine_target.h"

namespace rnmbake {

class Bevy final : public EngineTarget {
 public:
  [[nodiscard]] const char* name() const override { return "bevy"; }

  /// flat alone, as its Lightmap is.
  [[nodiscard]] const std::vector<std::string>& encodings() const override;

  [[nodiscard]] const std::vector<PageFormat>& formats() const override;
  void add_files(DeliveryFiles& files, nlohmann::ordered_json& record) const override;
};

}  // namespace rnmbake
