// pipeline/deliver/engines/raw_pages_target.h - engines in a browser that read no EXR (PlayCanvas,
// Babylon.js): raw pages, a decoder in the record, a module and a page to look at.
#pragma once

#include "pipeline/deliver/engine_target.h"
#include "pipeline/deliver/engines/shipped_files.h"

namespace rnmbake {

class RawPagesTarget final : public EngineTarget {
 public:
  /// `web_files`: of the engine's folder in web/.
  RawPagesTarget(const char* name, const ShippedFiles& web_files) : name_(name), web_files_(web_files) {}

  [[nodiscard]] const char* name() const override { return name_; }

  /// Those of three.js, and flat.
  [[nodiscard]] const std::vector<std::string>& encodings() const override;

  /// pageN.LAYER.rgba16f: four half floats for each texel, rows from the top, alpha 1, and no header.
  [[nodiscard]] nlohmann::ordered_json write_page(DeliveryFiles& files, std::size_t number,
                                                  Page page) const override;
  void add_files(DeliveryFiles& files, nlohmann::ordered_json& record) const override;

 private:
  const char* name_;
  const ShippedFiles& web_files_;
};

}  // namespace rnmbake
