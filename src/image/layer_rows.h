// image/layer_rows.h - the layers of a picture, read a few rows at a time, so that none has to fit into
// memory.
#pragma once

#include "image/channels.h"
#include "image/layered_exr.h"
#include "image/picture_rows.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

namespace rnmbake {

class LayerRows {
 public:
  static constexpr int band = 64;  // rows to read at once: whole zip blocks, and little memory

  /// Throws as PictureReader.
  explicit LayerRows(const std::filesystem::path& file);

  [[nodiscard]] const PictureFacts& facts() const { return reader_->facts(); }

  /// What read() returns of each row, at first every channel as read_image() has them. Layers may be renamed,
  /// and lose channels.
  [[nodiscard]] std::vector<ChannelGroup>& layers() { return layers_; }

  /// All layers and attributes; pictures are empty.
  [[nodiscard]] LayeredImage header() const;

  /// Rows [begin, end) of every layer, without attributes. Fastest from top to bottom. Throws
  /// Error(invalid_input) where the file ends early.
  [[nodiscard]] LayeredImage read(int begin, int end);

 private:
  std::unique_ptr<PictureReader> reader_;
  std::vector<ChannelGroup> layers_;
  std::vector<float> values_;  // of the rows at hand, as the file has them
};

/// Calls do_band(begin, end) for rows from top to bottom.
template <typename DoBand>
void each_band(int height, const DoBand& do_band) {
  for (int begin = 0; begin < height; begin += LayerRows::band)
    do_band(begin, std::min(begin + LayerRows::band, height));
}

}  // namespace rnmbake
