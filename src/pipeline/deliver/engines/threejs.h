// pipeline/deliver/engines/threejs.h - three.js: the module and the page of web/threejs/, and a decoder for
// them in the record.
#pragma once

#include "pipeline/deliver/engine_target.h"

namespace rnmbake {

class ThreeJs final : public EngineTarget {
 public:
  [[nodiscard]] const char* name() const override { return "threejs"; }
  [[nodiscard]] const std::vector<std::string>& encodings() const override;
  [[nodiscard]] const std::vector<PageFormat>& formats() const override;
  void add_files(DeliveryFiles& files, nlohmann::ordered_json& record) const override;
};

}  // namespace rnmbake
