#include "pipeline/lightmaps/lightmap_writer.h"

#include "lightmap/layout.h"

#include <algorithm>
#include <utility>

namespace rnmbake {

LightmapWriter::LightmapWriter(const std::filesystem::path& file, const LayeredImage& header, int width,
                               int height, Depth depth, bool split) {
  PictureForm form{
      width, height, {}, depth == Depth::half ? Storage::half : Storage::full, header.attributes};
  if (split) {
    for (const LayerFile& layer : one_file_per_layer(header)) {
      form.channels = layer.image.layers.front().channels;
      form.attributes = layer.image.attributes;
      std::filesystem::path name = file;
      add(name.replace_extension("." + layer.name + ".exr"), form);
    }
    return;
  }
  for (const Layer& layer : header.layers)
    for (const std::string& channel : layer.channels) form.channels.push_back(channel_name(layer, channel));
  add(file, form);
}

void LightmapWriter::add(const std::filesystem::path& file, const PictureForm& form) {
  Part& part = parts_.emplace_back();
  part.writer = std::make_unique<PictureWriter>(file, form);
  part.first = channels_;
  part.channels = form.channels.size();
  channels_ += form.channels.size();
  files_.push_back(file);
}

void LightmapWriter::write(int begin, int end, std::span<const float> values) {
  if (parts_.size() == 1) return parts_.front().writer->write(begin, end, values);
  const std::size_t texels = values.size() / channels_;
  std::vector<float> own;
  for (const Part& part : parts_) {
    own.resize(texels * part.channels);
    auto to = own.begin();
    for (std::size_t texel = 0; texel < texels; ++texel)
      to = std::ranges::copy(values.subspan(texel * channels_ + part.first, part.channels), to).out;
    part.writer->write(begin, end, own);
  }
}

void LightmapWriter::commit() {
  for (const Part& part : parts_) part.writer->commit();
}

}  // namespace rnmbake
