// pipeline/lightmaps/lightmap_rows.h - a lightmap in one file or one for each layer, read a few rows at a
// time.
#pragma once

#include "image/layer_rows.h"
#include "image/layered_exr.h"
#include "lightmap/metadata.h"
#include "pipeline/lightmaps/lightmap_place.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rnmbake {

class LightmapRows {
 public:
  static constexpr int band = LayerRows::band;

  /// Throws as load_lightmap().
  explicit LightmapRows(const LightmapPlace& place);

  [[nodiscard]] const std::string& file() const { return file_; }  // the first one, for messages
  [[nodiscard]] const LightmapMetadata& metadata() const { return metadata_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  /// All layers and attributes; pictures are empty.
  [[nodiscard]] const LayeredImage& header() const { return header_; }

  /// Rows [begin, end) of every layer. Fastest from top to bottom. Throws Error(invalid_input) where a file
  /// ends early.
  [[nodiscard]] LayeredImage read(int begin, int end);

 private:
  void open(const std::filesystem::path& path);

  std::string file_;
  std::vector<LayerRows> files_;  // colours without alpha
  LayeredImage header_;
  LightmapMetadata metadata_;
  int width_ = 0, height_ = 0;
};

}  // namespace rnmbake
