// pipeline/decode/lit_writer.h - the picture of a lit lightmap, written a few rows at a time.
#pragma once

#include "image/float_image.h"
#include "image/picture_rows.h"

#include <filesystem>
#include <string>

namespace rnmbake {

/// .exr: float, E/pi, times 2^exposure, with `variant` and exposure in its header. .png: to look at, as
/// write_display_png() has it.
class LitWriter {
 public:
  /// Throws as PictureWriter.
  LitWriter(const std::filesystem::path& file, int width, int height, const std::string& variant,
            float exposure);

  /// Rows [begin, end) of the picture, RGB in E/pi, from top to bottom without a gap.
  void write(int begin, int end, FloatImage&& lit);

  /// After the last row: the file appears under its name.
  void commit() { writer_.commit(); }

 private:
  bool is_display_;
  float gain_;
  PictureWriter writer_;
};

}  // namespace rnmbake
