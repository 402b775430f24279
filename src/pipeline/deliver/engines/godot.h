// pipeline/deliver/engines/godot.h - Godot 4: a scene with a LightmapGI whose data are the pages. No script.
#pragma once

#include "pipeline/deliver/engine_target.h"

namespace rnmbake {

class Godot final : public EngineTarget {
 public:
  [[nodiscard]] const char* name() const override { return "godot"; }

  /// What Godot's own shaders decode.
  [[nodiscard]] const std::vector<std::string>& encodings() const override;
  void pack(CodecOptions& codec) const override;
  [[nodiscard]] bool in_world() const override { return true; }

  /// They become slices of one array.
  [[nodiscard]] bool pages_alike() const override { return true; }

  /// One EXR of half floats: the slices from the top down, l0 and then t of y, z and x along Godot's axes.
  /// Throws Error(unsupported) where Godot cannot read a picture of that height.
  [[nodiscard]] nlohmann::ordered_json write_page(DeliveryFiles& files, std::size_t number,
                                                  Page page) const override;

  /// lightmaps.tres (LightmapGIData), lightmapped.tscn, and how Godot is to import the pages and the .glb.
  /// Throws Error(unsupported) where two names become one in Godot.
  void add_files(DeliveryFiles& files, nlohmann::ordered_json& record) const override;
};

}  // namespace rnmbake
