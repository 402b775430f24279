#include "base/error.h"
#include "image/channels.h"
#include "image/layered_exr.h"
#include "image/oiio_open.h"

#include <cstddef>
#include <new>

#include <OpenImageIO/imageio.h>

namespace rnmbake {
namespace {

Layer layer_of(const ChannelGroup& group, const OIIO::ImageSpec& spec, const std::vector<float>& pixels) {
  Layer layer{group.layer, group.channels,
              FloatImage(spec.width, spec.height, static_cast<int>(group.channels.size()))};
  auto& data = layer.pixels.data();
  for (std::size_t texel = 0, at = 0; texel < layer.pixels.texels(); ++texel)
    for (const int place : group.index) data[at++] = pixels[texel * spec.nchannels + place];
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
    image.layers.push_back(layer_of(in_usual_order(group), in->spec(), pixels));
  image.attributes = attributes_of(in->spec());
  return image;
} catch (const std::bad_alloc&) {
  fail(ExitCode::invalid_input, "{} does not fit into memory; scale it down", file.string());
}

}  // namespace rnmbake
