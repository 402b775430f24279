#include "base/error.h"
#include "image/oiio_open.h"
#include "image/picture_rows.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>

namespace rnmbake {

struct PictureReader::Input {
  std::unique_ptr<OIIO::ImageInput> file;
  int band_begin = 0, band_end = 0;  // rows of `band`, which holds one row of tiles
  std::vector<float> band;

  /// Files in tiles have no rows of their own.
  bool read_band(int row) {
    const OIIO::ImageSpec& spec = file->spec();
    if (row >= band_begin && row < band_end) return true;
    band_begin = row - row % spec.tile_height;
    band_end = std::min(band_begin + spec.tile_height, spec.height);
    band.resize(static_cast<std::size_t>(band_end - band_begin) * spec.width * spec.nchannels);
    return file->read_tiles(0, 0, spec.x, spec.x + spec.width, spec.y + band_begin, spec.y + band_end, spec.z,
                            spec.z + 1, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, band.data());
  }

  bool read_tiled_row(int row, int first, int channels, float* out) {
    if (!read_band(row)) return false;
    const OIIO::ImageSpec& spec = file->spec();
    const float* from = &band[static_cast<std::size_t>(row - band_begin) * spec.width * spec.nchannels];
    for (int x = 0; x < spec.width; ++x, from += spec.nchannels)
      out = std::copy_n(from + first, channels, out);
    return true;
  }

  bool read(int begin, int end, int first, int channels, float* out) {
    const OIIO::ImageSpec& spec = file->spec();
    if (spec.tile_width == 0) {
      return file->read_scanlines(0, 0, spec.y + begin, spec.y + end, spec.z, first, first + channels,
                                  OIIO::TypeDesc::FLOAT, out);
    }
    const std::size_t row_values = static_cast<std::size_t>(spec.width) * channels;
    for (int row = begin; row < end; ++row, out += row_values)
      if (!read_tiled_row(row, first, channels, out)) return false;
    return true;
  }
};

PictureReader::PictureReader(std::filesystem::path file)
    : file_(std::move(file)), input_(std::make_unique<Input>()) {
  input_->file = open_picture(file_);
  const OIIO::ImageSpec& spec = input_->file->spec();
  facts_ = {spec.width,          spec.height,        spec.channelnames, !spec.format.is_floating_point(),
            spec.format.c_str(), attributes_of(spec)};
}

PictureReader::~PictureReader() = default;

void PictureReader::read(int begin, int end, int first, int channels, std::span<float> out) {
  assert(begin >= 0 && begin <= end && end <= facts_.height);
  assert(out.size() == static_cast<std::size_t>(end - begin) * facts_.width * channels);
  const bool read = input_->read(begin, end, first, channels, out.data());
  // A truncated JPEG counts as read, with grey where it ends; only the pending message tells.
  if (!read || input_->file->has_error()) fail_damaged(file_, input_->file->geterror());
}

}  // namespace rnmbake
