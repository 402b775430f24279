// pipeline/lightmaps/lightmap_writer.h - a lightmap written a few rows at a time, in one file or one for each
// layer.
#pragma once

#include "base/numeric/stored_values.h"
#include "image/layered_exr.h"
#include "image/picture_rows.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace rnmbake {

class LightmapWriter {
 public:
  /// `header`: layers without pixels, and attributes. `file`: ends in .exr; with `split` each layer goes to
  /// NAME.LAYER.exr in the form of lightmap/layout.h. Throws as PictureWriter.
  LightmapWriter(const std::filesystem::path& file, const LayeredImage& header, int width, int height,
                 Depth depth, bool split);

  /// Rows [begin, end), from top to bottom without a gap: all channels of all layers, interleaved.
  void write(int begin, int end, std::span<const float> values);

  /// After the last row: the files appear under their names.
  void commit();

  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }

  /// Channels of all layers.
  [[nodiscard]] std::size_t channels() const { return channels_; }

 private:
  struct Part {
    std::unique_ptr<PictureWriter> writer;
    std::size_t first = 0, channels = 0;  // among those of all layers
  };

  void add(const std::filesystem::path& file, const PictureForm& form);

  std::vector<std::filesystem::path> files_;
  std::vector<Part> parts_;
  std::size_t channels_ = 0;
};

}  // namespace rnmbake
