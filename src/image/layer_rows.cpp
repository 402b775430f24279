#include "image/layer_rows.h"

#include <cstddef>
#include <utility>

namespace rnmbake {

LayerRows::LayerRows(const std::filesystem::path& file) : reader_(std::make_unique<PictureReader>(file)) {
  for (const ChannelGroup& group : channel_groups(facts().channels)) layers_.push_back(in_usual_order(group));
}

LayeredImage LayerRows::header() const {
  LayeredImage header;
  for (const ChannelGroup& layer : layers_) header.layers.push_back({layer.layer, layer.channels, {}});
  header.attributes = facts().attributes;
  return header;
}

LayeredImage LayerRows::read(int begin, int end) {
  const int width = facts().width;
  const std::size_t channels = facts().channels.size();
  values_.resize(static_cast<std::size_t>(end - begin) * width * channels);
  reader_->read(begin, end, 0, static_cast<int>(channels), values_);
  LayeredImage rows;
  for (const ChannelGroup& layer : layers_) {
    FloatImage pixels(width, end - begin, static_cast<int>(layer.channels.size()));
    float* to = pixels.data().data();
    for (const float* from = values_.data(); from != values_.data() + values_.size(); from += channels)
      for (const int place : layer.index) *to++ = from[place];
    rows.layers.push_back({layer.layer, layer.channels, std::move(pixels)});
  }
  return rows;
}

}  // namespace rnmbake
