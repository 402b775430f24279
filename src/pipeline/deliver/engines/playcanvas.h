// pipeline/deliver/engines/playcanvas.h - PlayCanvas: the module and the page of web/playcanvas/.
#pragma once

#include "pipeline/deliver/engines/raw_pages_target.h"

namespace rnmbake {

class PlayCanvas final : public RawPagesTarget {
 public:
  [[nodiscard]] const char* name() const override { return "playcanvas"; }

 private:
  [[nodiscard]] const std::vector<std::pair<const char*, const char*>>& web_files() const override;
};

}  // namespace rnmbake
