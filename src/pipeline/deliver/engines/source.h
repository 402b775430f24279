// pipeline/deliver/engines/source.h - Source: pages as .vtf in vrad's scale, materials, and a pixel shader.
#pragma once

#include "pipeline/deliver/engine_target.h"

#include <filesystem>

namespace rnmbake {

/// By which Source names what lies in a folder: the path below the last folder called "materials", or the
/// folder's own name where there is none. Ends with "/" unless it is empty.
[[nodiscard]] std::string source_texture_folder(const std::filesystem::path& folder);

class Source final : public EngineTarget {
 public:
  [[nodiscard]] const char* name() const override { return "source"; }

  /// rnm-vrad, whose mean is the flat map, and flat.
  [[nodiscard]] const std::vector<std::string>& encodings() const override;
  [[nodiscard]] bool powers_of_two() const override { return true; }

  /// pageN_LAYER.vtf, half floats: the flat page, and the three. Throws Error(unsupported) for a page that
  /// is larger than what Source 2013 loads.
  [[nodiscard]] nlohmann::ordered_json write_page(DeliveryFiles& files, std::size_t number,
                                                  Page page) const override;

  /// Materials of each page: pageN_flat.vmt by a shader of Source's own, pageN.vmt by that which goes with
  /// it; a normal map that looks straight up.
  void add_files(DeliveryFiles& files, nlohmann::ordered_json& record) const override;
};

}  // namespace rnmbake
