// pipeline/deliver/engines/unity.h - Unity: pages as lightmaps with one direction map for all colours
// (MonoSH), and the component that sets them.
#pragma once

#include "pipeline/deliver/engine_target.h"

namespace rnmbake {

class Unity final : public EngineTarget {
 public:
  [[nodiscard]] const char* name() const override { return "unity"; }

  /// sh2 for any shader that knows MonoSH; zh3 and geomerics for decoders that are not linear.
  [[nodiscard]] const std::vector<std::string>& encodings() const override;
  void pack(CodecOptions& codec) const override;
  [[nodiscard]] bool in_world() const override { return true; }

  /// pageN.l0.exr, half floats, and pageN.dir.png, 8 bits: t of x, y and z along Unity's axes.
  [[nodiscard]] nlohmann::ordered_json write_page(DeliveryFiles& files, std::size_t number,
                                                  Page page) const override;

  /// A .meta for each picture, the component with its menu, and the decoder.
  void add_files(DeliveryFiles& files, nlohmann::ordered_json& record) const override;
};

}  // namespace rnmbake
