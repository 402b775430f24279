#include "ssbump/map/direction_map.h"

#include "base/error.h"
#include "base/version.h"
#include "image/channels.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

constexpr std::string_view directions_convention = "self-shadowed bump map of directions";

std::string text_of(const std::map<std::string, Attribute>& attributes, const std::string& name) {
  const auto found = attributes.find("rnmbake:" + name);
  const auto* text = found == attributes.end() ? nullptr : std::get_if<std::string>(&found->second);
  return text == nullptr ? "" : *text;
}

[[noreturn]] void refuse_map(const std::filesystem::path& file, const std::string& what) {
  fail(ExitCode::invalid_input, "{} is no sound self-shadowed bump map: {}; make it again", file.string(),
       what);
}

Vec3 vector_of_basis(const std::map<std::string, Attribute>& attributes, const std::string& name,
                     const std::filesystem::path& file) {
  const auto found = attributes.find("rnmbake:basis:" + name);
  const auto* numbers = found == attributes.end() ? nullptr : std::get_if<std::vector<float>>(&found->second);
  if (numbers == nullptr || numbers->size() != 3)
    refuse_map(file, "the header has no vector of '" + name + "'");
  return {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

DirectionMapMetadata metadata_in(const PictureFacts& facts, const std::filesystem::path& file) {
  DirectionMapMetadata metadata;
  metadata.set.name = text_of(facts.attributes, "set");
  metadata.fit = text_of(facts.attributes, "fit");
  metadata.method = text_of(facts.attributes, "method");
  metadata.settings = text_of(facts.attributes, "settings");
  const std::string names = text_of(facts.attributes, "basis");
  for (std::size_t begin = 0; begin < names.size();) {
    const std::size_t end = std::min(names.find(',', begin), names.size());
    const std::string name = names.substr(begin, end - begin);
    metadata.set.directions.push_back({name, vector_of_basis(facts.attributes, name, file)});
    begin = end + 1;
  }
  (void)check_basis({file.string(), metadata.set.directions});
  return metadata;
}

FloatImage weights_in(PictureReader& reader, const BasisSet& set, const std::filesystem::path& file) {
  const PictureFacts& facts = reader.facts();
  std::vector<int> places;
  for (const BasisDirection& basis : set.directions) {
    const auto found = std::ranges::find(facts.channels, basis.name);
    if (found == facts.channels.end()) refuse_map(file, "it has no channel '" + basis.name + "'");
    places.push_back(static_cast<int>(found - facts.channels.begin()));
  }
  const auto channels = static_cast<int>(facts.channels.size());
  FloatImage all(facts.width, facts.height, channels);
  reader.read(0, facts.height, 0, channels, all.data());
  FloatImage weights = picked(all, places);
  if (!std::ranges::all_of(weights.data(), [](float value) { return std::isfinite(value); }))
    refuse_map(file, "a weight is not finite");
  return weights;
}

}  // namespace

PictureForm direction_map_form(const DirectionMapMetadata& metadata, int width, int height, Storage storage) {
  PictureForm form{width, height, {}, storage, {}};
  std::string names;
  const auto set = [&](const std::string& name, Attribute value) {
    form.attributes["rnmbake:" + name] = std::move(value);
  };
  for (const auto& [name, v] : metadata.set.directions) {
    form.channels.push_back(name);
    names += (names.empty() ? "" : ",") + name;
    set("basis:" + name, std::vector<float>{v.x, v.y, v.z});
  }
  set("convention", std::string(directions_convention));
  set("set", metadata.set.name);
  set("basis", names);
  set("space", std::string("tangent"));
  set("handedness", std::string("right"));
  set("green", std::string("y-up"));
  set("colour", std::string("data"));
  set("fit", metadata.fit);
  set("method", metadata.method);
  set("settings", metadata.settings);
  form.attributes["ImageDescription"] = fmt::format("{}; set={}; basis={}; E = sum of s_i LM_i",
                                                    directions_convention, metadata.set.name, names);
  form.attributes["Software"] = std::string("rnmbake ") + version;
  return form;
}

bool is_direction_map(const std::map<std::string, Attribute>& attributes) {
  return text_of(attributes, "convention") == directions_convention;
}

std::optional<DirectionMap> read_direction_map(const std::filesystem::path& file) {
  PictureReader reader(file);
  if (!is_direction_map(reader.facts().attributes)) return std::nullopt;
  DirectionMap map{metadata_in(reader.facts(), file), {}, reader.facts().storage};
  map.weights = weights_in(reader, map.metadata.set, file);
  return map;
}

}  // namespace rnmbake
