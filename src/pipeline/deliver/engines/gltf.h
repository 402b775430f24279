// pipeline/deliver/engines/gltf.h - the .glb and its pages, for whoever reads them.
#pragma once

#include "pipeline/deliver/engine_target.h"

namespace rnmbake {

class Gltf final : public EngineTarget {
 public:
  [[nodiscard]] const char* name() const override { return "gltf"; }

  /// flat, and all that three.js gets a decoder for.
  [[nodiscard]] const std::vector<std::string>& encodings() const override;

  [[nodiscard]] const std::vector<PageFormat>& formats() const override { return page_formats(); }
};

}  // namespace rnmbake
