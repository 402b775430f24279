#include "pipeline/lightmaps/lightmap_rows.h"

#include "base/error.h"
#include "encoding/encodings.h"
#include "lightmap/layout.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace rnmbake {
namespace {

/// Alpha, which some other program may have added, is no part of a lightmap.
void drop_alpha(ChannelGroup& group) {
  if (places_of(group.channels, "RGB").empty()) return;
  group.channels.resize(3);
  group.index.resize(3);
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
  LayerRows& file = files_.emplace_back(path);
  const PictureFacts& facts = file.facts();
  if (is_first) {
    width_ = facts.width;
    height_ = facts.height;
  } else if (width_ != facts.width || height_ != facts.height) {
    fail(ExitCode::invalid_input, "{} and {} belong to one object but differ in size; bake it again", file_,
         path.string());
  }
  for (ChannelGroup& layer : file.layers()) drop_alpha(layer);
  name_split_layer(facts, file.layers());
  LayeredImage header = file.header();
  std::ranges::move(header.layers, std::back_inserter(header_.layers));
  header_.attributes.merge(std::move(header.attributes));
}

LayeredImage LightmapRows::read(int begin, int end) {
  LayeredImage rows;
  for (LayerRows& file : files_)
    std::ranges::move(file.read(begin, end).layers, std::back_inserter(rows.layers));
  return rows;
}

}  // namespace rnmbake
