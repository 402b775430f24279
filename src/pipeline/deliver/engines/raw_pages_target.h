// pipeline/deliver/engines/raw_pages_target.h - engines in a browser that read no EXR: raw pages, a decoder
// in the record, a module and a page to look at.
#pragma once

#include "pipeline/deliver/engine_target.h"

#include <string>
#include <utility>
#include <vector>

namespace rnmbake {

class RawPagesTarget : public EngineTarget {
 public:
  /// Those of three.js, and flat.
  [[nodiscard]] const std::vector<std::string>& encodings() const override;
  [[nodiscard]] nlohmann::ordered_json write_page(DeliveryFiles& files, std::size_t number,
                                                  Page page) const override;
  void add_files(DeliveryFiles& files, nlohmann::ordered_json& record) const override;

 private:
  /// Name and text of each file of the engine's folder in web/.
  [[nodiscard]] virtual const std::vector<std::pair<const char*, const char*>>& web_files() const = 0;
};

}  // namespace rnmbake
