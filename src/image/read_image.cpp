#include "base/error.h"
#include "image/channels.h"
#include "image/layered_exr.h"
#include "image/oiio_open.h"

#include <algorithm>
#include <cstddef>
#include <new>
#include <numeric>
#include <string_view>

#include <OpenImageIO/imageio.h>

namespace rnmbake {
namespace {

/// Files list their channels by the alphabet; pixels are wanted as RGB or XYZ, with what else there is behind
/// and alpha at the end.
int rank_of(const std::string& channel) {
  static constexpr std::string_view order = "RGBXYZ";
  if (channel == "A") return static_cast<int>(order.size()) + 1;
  const auto found = channel.size() == 1 ? order.find(channel[0]) : std::string_view::npos;
  return static_cast<int>(found == std::string_view::npos ? order.size() : found);
}

Layer layer_of(const ChannelGroup& group, const OIIO::ImageSpec& spec, const std::vector<float>& pixels) {
  std::vector<std::size_t> order(group.channels.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t place) { return rank_of(group.channels[place]); });
  Layer layer{group.layer, {}, FloatImage(spec.width, spec.height, static_cast<int>(order.size()))};
  for (const std::size_t place : order) layer.channels.push_back(group.channels[place]);
  auto& data = layer.pixels.data();
  for (std::size_t texel = 0, at = 0; texel < layer.pixels.texels(); ++texel)
    for (const std::size_t place : order) data[at++] = pixels[texel * spec.nchannels + group.index[place]];
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
  for (const ChannelGroup& group : channel_groups(in->spec().channelnames))
    image.layers.push_back(layer_of(group, in->spec(), pixels));
  image.attributes = attributes_of(in->spec());
  return image;
} catch (const std::bad_alloc&) {
  fail(ExitCode::invalid_input, "{} does not fit into memory; scale it down", file.string());
}

}  // namespace rnmbake
