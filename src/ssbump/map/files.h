// ssbump/map/files.h - weights go in, rows of textures come out: the map itself, or ambient occlusion.
#pragma once

#include "image/float_image.h"
#include "image/picture_rows.h"
#include "ssbump/map/encode.h"
#include "ssbump/map/metadata.h"
#include "ssbump/map/weight_ranges.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rnmbake {

enum class SsbumpBits : std::uint8_t { chosen_by_ending, eight, sixteen, floats };

struct SsbumpOutput {
  std::filesystem::path file;  // .png, .tga, .tif, .exr
  SsbumpEncoding encoding;
  SsbumpBits bits = SsbumpBits::chosen_by_ending;
  bool dither = true;    // of 8 bits
  bool ao_only = false;  // one channel, ambient occlusion
  std::uint32_t seed = 0;
};

/// 8 bits where nothing was chosen, float in an .exr; 16 are half floats in an .exr. Throws Error(usage)
/// where the ending cannot hold them.
[[nodiscard]] Storage storage_of(const std::filesystem::path& file, SsbumpBits bits);

/// Takes weights (SsbumpWeights: five channels) in rows from top to bottom.
class SsbumpFile {
 public:
  /// `metadata`: power, method and settings; the rest is filled in from `output`.
  SsbumpFile(const SsbumpOutput& output, SsbumpMetadata metadata, int width, int height);

  /// `weights` is the picture from `first_row` on.
  void write(int first_row, const FloatImage& weights);

  /// Puts the file in place. Without this call no file is left.
  void commit() { writer_.commit(); }

  /// Ranges of the five channels over the rows so far.
  [[nodiscard]] std::vector<WeightRange> ranges() const { return ranges_.ranges(); }

 private:
  SsbumpOutput output_;
  Storage storage_;
  PictureWriter writer_;
  WeightRanges ranges_;
};

/// Packs rows of unit normals into a normal map's file; 16 bits are not dithered, 8 neither, as that would
/// make flat places noisy.
[[nodiscard]] PictureForm normal_map_form(int width, int height, Storage storage, bool y_down);

}  // namespace rnmbake
