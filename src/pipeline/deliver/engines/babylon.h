// pipeline/deliver/engines/babylon.h - Babylon.js: the module and the page of web/babylon/.
#pragma once

#include "pipeline/deliver/engines/raw_pages_target.h"

namespace rnmbake {

class Babylon final : public RawPagesTarget {
 public:
  [[nodiscard]] const char* name() const override { return "babylon"; }

 private:
  [[nodiscard]] const std::vector<std::pair<const char*, const char*>>& web_files() const override;
};

}  // namespace rnmbake
