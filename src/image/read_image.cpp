#include "base/error.h"
#include "image/layered_exr.h"
#include "image/oiio_open.h"

#include <algorithm>
#include <map>
#include <new>

#include <OpenImageIO/imageio.h>

namespace rnmbake {
namespace {

/// Where a channel of the file belongs: `index` is its place among the file's channels.
struct ChannelPlace {
  std::string layer, channel;
  int index = 0;
};

/// `rnm0.R` -> rnm0, R; `R` -> "", R; `coverage` -> coverage, "" (see Layer).
ChannelPlace place_of(const std::string& name, int index) {
  const auto dot = name.rfind('.');
  if (dot != std::string::npos) return {name.substr(0, dot), name.substr(dot + 1), index};
  if (name.size() == 1) return {"", name, index};
  return {name, "", index};
}

/// Files list their channels by the alphabet; pixels are wanted as RGBA or XYZ.
int rank_of(const std::string& channel) {
  static constexpr std::string_view kOrder = "RGBAXYZ";
  const auto found = channel.size() == 1 ? kOrder.find(channel[0]) : std::string_view::npos;
  return static_cast<int>(found == std::string_view::npos ? kOrder.size() : found);
}

std::map<std::string, std::vector<ChannelPlace>> grouped(const OIIO::ImageSpec& spec) {
  std::map<std::string, std::vector<ChannelPlace>> layers;
  for (int c = 0; c < spec.nchannels; ++c) {
    const ChannelPlace place = place_of(spec.channelnames[static_cast<std::size_t>(c)], c);
    layers[place.layer].push_back(place);
  }
  for (auto& [name, places] : layers) {
    std::ranges::stable_sort(places, {}, [](const ChannelPlace& place) { return rank_of(place.channel); });
  }
  return layers;
}

Layer layer_of(const std::string& name, const std::vector<ChannelPlace>& places, const OIIO::ImageSpec& spec,
               const std::vector<float>& pixels) {
  Layer layer{name, {}, FloatImage(spec.width, spec.height, static_cast<int>(places.size()))};
  for (const ChannelPlace& place : places) layer.channels.push_back(place.channel);
  auto& data = layer.pixels.data();
  for (std::size_t texel = 0, at = 0; texel < layer.pixels.texels(); ++texel)
    for (const ChannelPlace& place : places) data[at++] = pixels[texel * spec.nchannels + place.index];
  return layer;
}

std::vector<float> pixels_of(const std::filesystem::path& file, OIIO::ImageInput& in) {
  const OIIO::ImageSpec& spec = in.spec();
  std::vector<float> pixels(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  const bool read = in.read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.data());
  // A truncated JPEG counts as read, with grey where it ends; only the pending message tells.
  if (!read || in.has_error()) fail_damaged(file, in.geterror());
  return pixels;
}

}  // namespace

LayeredImage read_image(const std::filesystem::path& file) try {
  const auto in = open_picture(file);
  const std::vector<float> pixels = pixels_of(file, *in);
  LayeredImage image;
  for (const auto& [name, places] : grouped(in->spec()))
    image.layers.push_back(layer_of(name, places, in->spec(), pixels));
  image.attributes = attributes_of(in->spec());
  return image;
} catch (const std::bad_alloc&) {
  fail(ExitCode::invalid_input, "{} does not fit into memory; scale it down", file.string());
}

}  // namespace rnmbake
