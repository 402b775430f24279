#include "ssbump/map/picture.h"

#include "base/error.h"
#include "base/log.h"
#include "image/channels.h"
#include "ssbump/map/direction_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rnmbake {
namespace {

FloatImage pixels_of(PictureReader& reader, const std::string& file) {
  const PictureFacts& facts = reader.facts();
  const auto channels = static_cast<int>(facts.channels.size());
  auto places = colour_channels(facts.channels, file, "save the map as a picture of its own");
  if (places.empty()) {
    fail(ExitCode::invalid_input, "{}: its channels are {}; a self-shadowed bump map has R, G, B and maybe A",
         file, listed(facts.channels));
  }
  if (const auto alpha = places_of(facts.channels, "A"); !alpha.empty()) places.push_back(alpha.front());
  FloatImage all(facts.width, facts.height, channels);
  reader.read(0, facts.height, 0, channels, all.data());
  FloatImage pixels = picked(all, places);
  const auto bad = std::ranges::find_if_not(pixels.data(), [](float value) { return std::isfinite(value); });
  if (bad != pixels.data().end()) {
    const auto texel = (bad - pixels.data().begin()) / pixels.channels();
    fail(ExitCode::invalid_input, "{}: texel ({}, {}) from the top left is not finite; make the map again",
         file, texel % facts.width, texel / facts.width);
  }
  return pixels;
}

template <typename Value>
void check_told(const std::string& file, const char* flag, const std::optional<Value>& hints, Value said) {
  if (hints && *hints != said) {
    fail(ExitCode::usage, "{} says of itself that it is --{} {}, not {}; leave out the flag", file, flag,
         name_of(said), name_of(*hints));
  }
}

SsbumpMetadata assumed(const std::string& file, const SsbumpHints& hints) {
  SsbumpMetadata metadata;
  metadata.scale = hints.scale.value_or(SsbumpScale::third);
  metadata.handed = hints.handed.value_or(Handed::right);
  metadata.alpha = hints.alpha.value_or(SsbumpAlpha::none);
  if (!hints.scale || !hints.handed) {
    log::warn("{} does not say what it holds; taken as --scale {} --handed {}", file, name_of(metadata.scale),
              name_of(metadata.handed));
  }
  return metadata;
}

}  // namespace

SsbumpPicture read_ssbump(const std::filesystem::path& file, const SsbumpHints& hints) {
  PictureReader reader(file);
  if (is_direction_map(reader.facts().attributes)) {
    fail(ExitCode::unsupported,
         "{} holds weights of a set of directions, which 'ssbump info' and 'decode' read; give a map of the "
         "three axes, made without --basis-set",
         file.string());
  }
  SsbumpPicture picture;
  const auto own = ssbump_metadata(reader.facts().attributes, file.string());
  picture.knows_itself = own.has_value();
  picture.metadata = own ? *own : assumed(file.string(), hints);
  if (own) {
    check_told(file.string(), "scale", hints.scale, own->scale);
    check_told(file.string(), "handed", hints.handed, own->handed);
    check_told(file.string(), "alpha", hints.alpha, own->alpha);
  }
  picture.storage = reader.facts().storage;
  const FloatImage pixels = pixels_of(reader, file.string());
  if (picture.metadata.alpha != SsbumpAlpha::none && pixels.channels() < 4)
    fail(ExitCode::invalid_input, "{} has no fourth channel, and should hold '{}' there; make the map again",
         file.string(), name_of(picture.metadata.alpha));
  picture.weights = decode_weights(pixels, encoding_of(picture.metadata));
  return picture;
}

void write_ssbump(const SsbumpOutput& output, const SsbumpMetadata& metadata, const FloatImage& weights) {
  SsbumpFile file(output, metadata, weights.width(), weights.height());
  file.write(0, weights);
  file.commit();
}

SsbumpEncoding encoding_of(const SsbumpMetadata& metadata) {
  return {metadata.scale, metadata.handed, metadata.alpha};
}

}  // namespace rnmbake
