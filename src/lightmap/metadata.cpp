#include "lightmap/metadata.h"

#include "base/error.h"
#include "encoding/codecs/make_codec.h"
#include "encoding/encodings.h"
#include "lightmap/layout.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace rnmbake {
namespace {

const std::string prefix = "rnmbake:";

/// Attributes of one file by their short names; every message names the file.
class Header {
 public:
  Header(const LayeredImage& image, const std::string& file) : attributes_(image.attributes), file_(file) {}

  template <typename T>
  [[nodiscard]] T required(const std::string& name) const {
    const auto found = attributes_.find(prefix + name);
    if (found == attributes_.end()) refuse("the header lacks " + prefix + name);
    const T* value = std::get_if<T>(&found->second);
    if (value == nullptr) refuse("header attribute " + prefix + name + " has the wrong type");
    return *value;
  }

  template <typename T>
  void optional(const std::string& name, T& value) const {
    if (attributes_.contains(prefix + name)) value = required<T>(name);
  }

  [[noreturn]] void refuse(const std::string& what) const {
    fail(ExitCode::invalid_input, "{} is not a sound lightmap: {}; bake it again", file_, what);
  }

 private:
  const std::map<std::string, Attribute>& attributes_;
  const std::string& file_;
};

template <typename Enum>
Enum one_of(const Header& header, const std::string& name, std::initializer_list<Enum> values) {
  const auto text = header.required<std::string>(name);
  for (const Enum value : values)
    if (text == name_of(value)) return value;
  header.refuse(prefix + name + " is '" + text + "'");
}

/// Conventions of converted lightmaps are the names of their codecs; bakes themselves go by their definition.
bool is_codec(const std::string& convention) {
  return convention != baked_codec && std::ranges::count(codec_names(), convention) > 0;
}

/// One direction is a list of three floats, which some readers hand back as a plain list.
Vec3 direction_of(const Header& header, const std::string& name) {
  const auto numbers = header.required<std::vector<float>>("basis:" + name);
  if (numbers.size() != 3) header.refuse(prefix + "basis:" + name + " does not have 3 numbers");
  const Vec3 direction(numbers[0], numbers[1], numbers[2]);
  if (!(std::abs(direction.length() - 1) < 1e-3F))
    header.refuse(prefix + "basis:" + name + " is not of unit length");
  return direction;
}

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin <= list.size();) {
    const auto end = std::min(list.find(',', begin), list.size());
    if (end > begin) names.push_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  return names;
}

void check_layer(const Header& header, const LayeredImage& image, const std::string& name) {
  const Layer* layer = image.find(exr_layer(name));
  if (layer != nullptr && layer->channels == std::vector<std::string>{"R", "G", "B"}) return;
  header.refuse("the header lists basis '" + name + "' but there is no RGB layer of it");
}

std::vector<BasisDirection> bases_of(const Header& header, const LayeredImage& image) {
  const bool is_whole = !image.attributes.contains(layer_attribute);
  const bool holds_bakes = !is_codec(header.required<std::string>("convention"));
  std::vector<BasisDirection> bases;
  for (const std::string& name : split(header.required<std::string>("basis"))) {
    if (std::ranges::count(bases, name, &BasisDirection::name) > 0)
      header.refuse("basis '" + name + "' is listed twice");
    bases.push_back({name, direction_of(header, name)});
    if (is_whole && holds_bakes) check_layer(header, image, name);
  }
  if (bases.empty()) header.refuse(prefix + "basis lists nothing");
  return bases;
}

CodecOptions codec_of(const Header& header, const std::string& convention) {
  CodecOptions codec{convention};
  float range = 0;
  int is_mono = 0;
  header.optional("range", range);
  header.optional("bits", codec.bits);
  header.optional("mono", is_mono);
  codec.range = range;
  codec.mono = is_mono != 0;
  return codec;
}

void read_origin(const Header& header, LightmapMetadata& metadata) {
  header.optional("engine", metadata.engine);
  header.optional("recipe", metadata.recipe);
  header.optional("horizon", metadata.horizon);
  header.optional("footprint", metadata.footprint);
  header.optional("samples", metadata.samples);
  header.optional("bounces", metadata.bounces);
  header.optional("seed", metadata.seed);
  int repaired = 0;
  header.optional("repaired", repaired);
  metadata.repaired = repaired != 0;
  header.optional("version", metadata.rnmbake_version);
  header.optional("blender", metadata.blender_version);
  header.optional("object", metadata.object);
  header.optional("uv", metadata.uv_layer);
  header.optional("tangent_uv", metadata.tangent_uv_layer);
  header.optional("model", metadata.model);
  header.optional("faults", metadata.faults);
  header.optional("error", metadata.error);
}

void check_agreement(const Header& header, const LightmapMetadata& metadata) {
  const auto flat = std::ranges::find(metadata.bases, flat_direction().name, &BasisDirection::name);
  const bool has_flat = flat != metadata.bases.end();
  if (has_flat && (flat->direction - flat_direction().direction).length() > 1e-3F) {
    header.refuse("basis 'flat' is not (0, 0, 1)");
  }
  if (metadata.normalize == Normalize::flat && !(has_flat && holds_rnm({"header", metadata.bases}))) {
    header.refuse(
        prefix +
        "normalize is 'flat' but the flat bake or one of the three Half-Life 2 directions is missing");
  }
}

}  // namespace

const char* name_of(Green green) {
  return green == Green::y_up ? "y-up" : "y-down";
}
const char* name_of(Normalize normalize) {
  return normalize == Normalize::none ? "none" : "flat";
}

bool LightmapMetadata::is_encoded() const {
  return is_codec(convention);
}

void LightmapMetadata::set_codec(const CodecOptions& options) {
  codec = options;
  convention = options.name == baked_codec ? clipped_hemisphere_integral : options.name;
  if (!is_baked()) normalize = Normalize::none;
}

bool has_metadata(const LayeredImage& image) {
  return image.attributes.contains(prefix + "convention");
}

void write_metadata(const LightmapMetadata& metadata, LayeredImage& image) {
  const auto set = [&](const char* name, Attribute value) {
    image.attributes[prefix + name] = std::move(value);
  };
  set("convention", metadata.convention);
  set("units", metadata.units);
  set("space", metadata.space);
  set("handedness", metadata.handedness);
  set("green", name_of(metadata.green));
  set("normalize", name_of(metadata.normalize));
  std::string names;
  for (const auto& [name, v] : metadata.bases) {
    names += (names.empty() ? "" : ",") + name;
    set(("basis:" + name).c_str(), std::vector<float>{v.x, v.y, v.z});
  }
  set("basis", names);
  if (metadata.is_encoded() && metadata.codec.range > 0) {
    set("range", static_cast<float>(metadata.codec.range));
    set("bits", metadata.codec.bits);
    set("mono", metadata.codec.mono ? 1 : 0);
  }
  if (!metadata.engine.empty()) set("engine", metadata.engine);
  set("recipe", metadata.recipe);
  set("horizon", metadata.horizon);
  set("footprint", metadata.footprint);
  set("samples", metadata.samples);
  set("bounces", metadata.bounces);
  set("seed", metadata.seed);
  set("repaired", metadata.repaired ? 1 : 0);
  set("version", metadata.rnmbake_version);
  set("blender", metadata.blender_version);
  set("object", metadata.object);
  set("uv", metadata.uv_layer);
  set("tangent_uv", metadata.tangent_uv_layer);
  if (metadata.model.empty()) return;
  set("model", metadata.model);
  set("faults", metadata.faults);
  set("error", metadata.error);
}

LightmapMetadata read_metadata(const LayeredImage& image, const std::string& file) {
  const Header header(image, file);
  LightmapMetadata metadata;
  metadata.convention = header.required<std::string>("convention");
  metadata.units = header.required<std::string>("units");
  metadata.space = header.required<std::string>("space");
  metadata.handedness = header.required<std::string>("handedness");
  metadata.green = one_of(header, "green", {Green::y_up, Green::y_down});
  metadata.normalize = one_of(header, "normalize", {Normalize::none, Normalize::flat});
  metadata.bases = bases_of(header, image);
  if (metadata.is_encoded()) metadata.codec = codec_of(header, metadata.convention);
  read_origin(header, metadata);
  check_agreement(header, metadata);
  return metadata;
}

}  // namespace rnmbake
