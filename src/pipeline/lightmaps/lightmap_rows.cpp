#include "pipeline/lightmaps/lightmap_rows.h"

#include "base/error.h"
#include "encoding/encodings.h"
#include "lightmap/layout.h"

#include <cstddef>
#include <utility>

namespace rnmbake {
namespace {

/// Alpha, which some other program may have added, is no part of a lightmap.
ChannelGroup without_alpha(ChannelGroup group) {
  if (places_of(group.channels, "RGB").empty()) return group;
  group.channels.resize(3);
  group.index.resize(3);
  return group;
}

/// The layer that a file of a split lightmap says it holds (lightmap/layout.h).
void name_split_layer(const PictureFacts& facts, std::vector<ChannelGroup>& layers) {
  const auto found = facts.attributes.find(layer_attribute);
  const auto* name = found == facts.attributes.end() ? nullptr : std::get_if<std::string>(&found->second);
  if (name != nullptr && layers.size() == 1) layers.front().layer = exr_layer(*name);
}

}  // namespace

LightmapRows::LightmapRows(const LightmapPlace& place) : file_(place.files.front().string()) {
  for (const std::filesystem::path& path : place.files) open(path);
  if (place.files.size() > 1) header_.attributes.erase(layer_attribute);  // all layers are here
  if (!has_metadata(header_)) {
    fail(ExitCode::invalid_input, "{} is no lightmap of rnmbake: its header names no convention", file_);
  }
  metadata_ = read_metadata(header_, file_);
}

void LightmapRows::open(const std::filesystem::path& path) {
  const bool is_first = files_.empty();
  File& file = files_.emplace_back();
  file.reader = std::make_unique<PictureReader>(path);
  const PictureFacts& facts = file.reader->facts();
  if (is_first) {
    width_ = facts.width;
    height_ = facts.height;
  } else if (width_ != facts.width || height_ != facts.height) {
    fail(ExitCode::invalid_input, "{} and {} belong to one object but differ in size; bake it again", file_,
         path.string());
  }
  for (const ChannelGroup& group : channel_groups(facts.channels))
    file.layers.push_back(without_alpha(in_usual_order(group)));
  name_split_layer(facts, file.layers);
  for (const ChannelGroup& layer : file.layers) header_.layers.push_back({layer.layer, layer.channels, {}});
  auto attributes = facts.attributes;
  header_.attributes.merge(std::move(attributes));
}

LayeredImage LightmapRows::read(int begin, int end) {
  LayeredImage rows;
  std::vector<float> values;
  for (File& file : files_) {
    const std::size_t channels = file.reader->facts().channels.size();
    values.resize(static_cast<std::size_t>(end - begin) * width_ * channels);
    file.reader->read(begin, end, 0, static_cast<int>(channels), values);
    for (const ChannelGroup& layer : file.layers) {
      FloatImage pixels(width_, end - begin, static_cast<int>(layer.channels.size()));
      float* to = pixels.data().data();
      for (const float* from = values.data(); from != values.data() + values.size(); from += channels)
        for (const int place : layer.index) *to++ = from[place];
      rows.layers.push_back({layer.layer, layer.channels, std::move(pixels)});
    }
  }
  return rows;
}

}  // namespace rnmbake
