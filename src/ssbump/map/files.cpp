#include "ssbump/map/files.h"

#include "base/error.h"
#include "base/text.h"
#include "ssbump/map/weights.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace rnmbake {
namespace {

bool is_exr(const std::filesystem::path& file) {
  return lower_extension(file) == ".exr";
}

Storage meant_by(const std::filesystem::path& file, SsbumpBits bits) {
  if (bits == SsbumpBits::chosen_by_ending) return is_exr(file) ? Storage::full : Storage::u8;
  if (bits == SsbumpBits::eight) return Storage::u8;
  if (bits == SsbumpBits::sixteen) return is_exr(file) ? Storage::half : Storage::u16;
  return Storage::full;
}

PictureForm form_of(const SsbumpOutput& output, Storage storage, SsbumpMetadata metadata, int width,
                    int height) {
  PictureForm form{width, height, {"R", "G", "B"}, storage, {}};
  if (output.ao_only) {
    form.channels = {"Y"};
    form.attributes = {{"ImageDescription", Attribute(std::string("ambient occlusion; 1 is open"))}};
    return form;
  }
  if (output.encoding.alpha != SsbumpAlpha::none) form.channels.emplace_back("A");
  metadata.scale = output.encoding.scale;
  metadata.handed = output.encoding.handed;
  metadata.alpha = output.encoding.alpha;
  form.attributes = attributes_of(metadata);
  return form;
}

FloatImage ambient_of(const FloatImage& weights) {
  FloatImage ambient(weights.width(), weights.height(), 1);
  for (std::size_t i = 0; i < ambient.data().size(); ++i)
    ambient.data()[i] = weights.data()[i * SsbumpWeights::channels + SsbumpWeights::ambient];
  return ambient;
}

}  // namespace

Storage storage_of(const std::filesystem::path& file, SsbumpBits bits) {
  const Storage storage = meant_by(file, bits);
  const std::string obstacle = storage_obstacle(file, storage);
  if (!obstacle.empty()) fail(ExitCode::usage, "cannot write {}: {}", file.string(), obstacle);
  return storage;
}

SsbumpFile::SsbumpFile(const SsbumpOutput& output, SsbumpMetadata metadata, int width, int height)
    : output_(output),
      storage_(storage_of(output.file, output.bits)),
      writer_(output.file, form_of(output, storage_, std::move(metadata), width, height)) {}

void SsbumpFile::write(int first_row, const FloatImage& weights) {
  ranges_.add(weights);
  FloatImage stored = output_.ao_only ? ambient_of(weights) : encode(weights, output_.encoding);
  if (output_.dither && storage_ == Storage::u8) dither(stored, storage_, output_.seed, first_row);
  writer_.write(first_row, first_row + stored.height(), stored.data());
}

PictureForm normal_map_form(int width, int height, Storage storage, bool y_down) {
  return {width,
          height,
          {"R", "G", "B"},
          storage,
          {{"ImageDescription", Attribute(std::string(y_down ? "tangent-space normals; green=y-down"
                                                             : "tangent-space normals; green=y-up"))},
           {"rnmbake:green", Attribute(std::string(y_down ? "y-down" : "y-up"))}}};
}

}  // namespace rnmbake
