#include "image/layered_exr.h"

#include "base/error.h"
#include "image/oiio_bytes.h"
#include "image/oiio_open.h"

#include <algorithm>
#include <cstddef>

namespace rnmbake {
namespace {

void check(const std::filesystem::path& file, const LayeredImage& image) {
  if (image.layers.empty()) fail(ExitCode::invalid_input, "{}: there is no layer to write", file.string());
  const FloatImage& first = image.layers.front().pixels;
  for (const Layer& layer : image.layers) {
    const FloatImage& pixels = layer.pixels;
    if (pixels.empty() || pixels.width() != first.width() || pixels.height() != first.height()) {
      fail(ExitCode::invalid_input, "{}: layer '{}' has {}x{} texels where the first layer has {}x{}",
           file.string(), layer.name, pixels.width(), pixels.height(), first.width(), first.height());
    }
    if (static_cast<std::size_t>(pixels.channels()) != layer.channels.size()) {
      fail(ExitCode::invalid_input, "{}: layer '{}' has {} channels but {} channel names", file.string(),
           layer.name, pixels.channels(), layer.channels.size());
    }
  }
}

OIIO::ImageSpec spec_of(const LayeredImage& image, Depth depth) {
  const FloatImage& first = image.layers.front().pixels;
  OIIO::ImageSpec spec(first.width(), first.height(), 0,
                       depth == Depth::half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
  spec.channelnames.clear();
  for (const Layer& layer : image.layers)
    for (const std::string& channel : layer.channels)
      spec.channelnames.push_back(channel_name(layer, channel));
  spec.nchannels = static_cast<int>(spec.channelnames.size());
  for (const auto& [name, value] : image.attributes) set_attribute(spec, name, value);
  spec.attribute("compression", "zip");
  // Without one the writer stores the time of day, and two equal bakes would differ.
  spec.attribute("DateTime", "");
  return spec;
}

/// Channels of all layers side by side, for rows [begin, end).
std::vector<float> interleaved_rows(const LayeredImage& image, std::size_t channels, int begin, int end) {
  const int width = image.layers.front().pixels.width();
  std::vector<float> rows(static_cast<std::size_t>(end - begin) * width * channels);
  std::size_t first_channel = 0;
  for (const Layer& layer : image.layers) {
    std::size_t texel = 0;
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < width; ++x, ++texel)
        std::ranges::copy(layer.pixels.texel(x, y), &rows[texel * channels + first_channel]);
    }
    first_channel += layer.channels.size();
  }
  return rows;
}

bool write_rows(OIIO::ImageOutput& out, const LayeredImage& image, const OIIO::ImageSpec& spec) {
  constexpr int rows_at_once = 64;  // whole zip blocks, and little memory beside the image
  for (int y = 0; y < spec.height; y += rows_at_once) {
    const int end = std::min(y + rows_at_once, spec.height);
    const auto rows = interleaved_rows(image, static_cast<std::size_t>(spec.nchannels), y, end);
    if (!out.write_scanlines(y, end, 0, OIIO::TypeDesc::FLOAT, rows.data())) return false;
  }
  return true;
}

}  // namespace

std::string channel_name(const Layer& layer, const std::string& channel) {
  if (layer.name.empty() || channel.empty()) return layer.name + channel;
  return layer.name + "." + channel;
}

const Layer* LayeredImage::find(const std::string& name) const {
  const auto found = std::ranges::find(layers, name, &Layer::name);
  return found == layers.end() ? nullptr : &*found;
}

void write_exr(const std::filesystem::path& file, const LayeredImage& image, Depth depth) {
  check(file, image);
  const OIIO::ImageSpec spec = spec_of(image, depth);
  write_encoded(file, "exr", spec, [&](OIIO::ImageOutput& out) { return write_rows(out, image, spec); });
}

}  // namespace rnmbake
