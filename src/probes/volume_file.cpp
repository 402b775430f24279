#include "probes/volume_file.h"

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "base/json.h"
#include "base/names.h"
#include "base/read_file.h"
#include "image/layered_exr.h"
#include "probes/tree_file.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int volume_format = 1;
constexpr const char* file_name = "probes.json";

struct PictureSize {
  int width = 0, height = 0;
};

PictureSize size_of(const ProbeVolume& volume) {
  if (volume.tree) return {square_width(volume.probes.size()), square_height(volume.probes.size())};
  if (!volume.grid) return {static_cast<int>(volume.probes.size()), 1};
  const auto& counts = volume.grid->counts;
  return {counts[0], counts[1] * counts[2]};
}

/// A layer of three channels, filled from each probe; x fastest, as probes are ordered.
Layer layer_of(const ProbeVolume& volume, const std::string& name,
               const std::function<Vec3(const LightProbe&)>& value) {
  const auto [width, height] = size_of(volume);
  Layer layer{name, {"R", "G", "B"}, FloatImage(width, height, 3)};
  for (std::size_t i = 0; i < volume.probes.size(); ++i) {
    const auto at = static_cast<int>(i);
    set_vec3(layer.pixels, at % width, at / width, value(volume.probes[i]));
  }
  return layer;
}

/// A layer of one channel.
Layer number_layer(const ProbeVolume& volume, const std::string& name,
                   const std::function<float(const LightProbe&)>& value) {
  const auto [width, height] = size_of(volume);
  Layer layer{name, {""}, FloatImage(width, height, 1)};
  std::ranges::transform(volume.probes, layer.pixels.data().begin(), value);
  return layer;
}

std::string error_layer(std::size_t direction) {
  return std::string("error_") + probe_direction_names()[direction];
}

LayeredImage picture_of(const ProbeVolume& volume) {
  LayeredImage image;
  for (std::size_t k = 0; k < probe_direction_count; ++k) {
    image.layers.push_back(layer_of(volume, probe_direction_names()[k],
                                    [k](const LightProbe& probe) { return probe.irradiance[k]; }));
    image.layers.push_back(
        layer_of(volume, error_layer(k), [k](const LightProbe& probe) { return probe.standard_error[k]; }));
  }
  for (std::size_t k = 0; k < 9; ++k) {
    image.layers.push_back(layer_of(volume, "sh" + std::to_string(k),
                                    [k](const LightProbe& probe) { return probe.harmonics[k]; }));
  }
  Layer place = layer_of(volume, "position", [](const LightProbe& probe) { return Vec3(probe.position); });
  place.channels = {"X", "Y", "Z"};
  image.layers.push_back(std::move(place));
  image.layers.push_back(
      number_layer(volume, "validity", [](const LightProbe& probe) { return probe.validity; }));
  image.layers.push_back(
      number_layer(volume, "state", [](const LightProbe& probe) { return static_cast<float>(probe.state); }));
  return image;
}

/// Maps of distances side by side, as their probes are in the other picture.
LayeredImage depth_picture(const ProbeVolume& volume) {
  const auto [width, height] = size_of(volume);
  const int side = volume.depths.side;
  Layer layer{"depth", {"mean", "square"}, FloatImage(width * side, height * side, 2)};
  const auto texels = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  for (std::size_t i = 0; i < volume.probes.size(); ++i) {
    const auto at = static_cast<int>(i);
    for (std::size_t t = 0; t < texels; ++t) {
      const auto texel = layer.pixels.texel(at % width * side + static_cast<int>(t) % side,
                                            at / width * side + static_cast<int>(t) / side);
      texel[0] = volume.depths.mean[i * texels + t];
      texel[1] = volume.depths.square[i * texels + t];
    }
  }
  LayeredImage image;
  image.layers.push_back(std::move(layer));
  return image;
}

json json_of(const Vec3d& v) {
  return {v.x, v.y, v.z};
}

json json_of(const ProbeVolume& volume, const std::string& stem) {
  json entry{{"name", volume.name}, {"file", stem + ".exr"}, {"probes", volume.probes.size()}};
  if (volume.grid) {
    const ProbeGrid& grid = *volume.grid;
    entry["grid"] = {{"counts", grid.counts},
                     {"first", json_of(grid.first)},
                     {"steps", {json_of(grid.steps[0]), json_of(grid.steps[1]), json_of(grid.steps[2])}}};
  }
  if (volume.tree) {
    entry["tree"] = {{"file", stem + "_tree.exr"},
                     {"cells", volume.tree->cells.size()},
                     {"levels", depth_of(*volume.grid, *volume.tree)}};
  }
  if (volume.depths.side > 0) entry["depth"] = {{"file", stem + "_depth.exr"}, {"side", volume.depths.side}};
  return entry;
}

Vec3d vec3_of(const json& values) {
  const auto v = values.get<std::array<double, 3>>();
  return {v[0], v[1], v[2]};
}

fs::path file_at(const json& entry, const fs::path& folder) {
  const auto file = file_inside(folder, entry.at("file").get<std::string>());
  if (!file)
    fail(ExitCode::invalid_input, "'file' is {}, which is no plain file name", brief(entry.at("file")));
  return *file;
}

ProbeGrid grid_of(const json& entry) {
  ProbeGrid grid;
  grid.counts = entry.at("counts").get<std::array<int, 3>>();
  grid.first = vec3_of(entry.at("first"));
  for (std::size_t axis = 0; axis < 3; ++axis) grid.steps[axis] = vec3_of(entry.at("steps").at(axis));
  for (const int count : grid.counts) {
    if (count < 1 || count > most_probes) fail(ExitCode::invalid_input, "a grid of {} probes", count);
  }
  if (!(std::abs(grid.steps[0].cross(grid.steps[1]).dot(grid.steps[2])) > 0))
    fail(ExitCode::invalid_input, "the steps of its grid span no space");
  return grid;
}

/// The layer's texels by their number; finite.
class LayerReader {
 public:
  LayerReader(const LayeredImage& image, const std::string& name, int channels, std::size_t texels) {
    const Layer* layer = image.find(name);
    if (layer == nullptr || layer->pixels.channels() < channels)
      fail(ExitCode::invalid_input, "it lacks the layer '{}'", name);
    pixels_ = &layer->pixels;
    if (pixels_->texels() != texels) {
      fail(ExitCode::invalid_input, "it has {} x {} texels, not {}", pixels_->width(), pixels_->height(),
           texels);
    }
    for (const float value : pixels_->data()) {
      if (!std::isfinite(value))
        fail(ExitCode::invalid_input, "the layer '{}' has values that are no numbers", name);
    }
  }
  [[nodiscard]] std::span<const float> operator[](std::size_t i) const {
    return std::span(pixels_->data())
        .subspan(i * std::size_t(pixels_->channels()), std::size_t(pixels_->channels()));
  }
  [[nodiscard]] Vec3 vec3(std::size_t i) const {
    const auto texel = (*this)[i];
    return {texel[0], texel[1], texel[2]};
  }

 private:
  const FloatImage* pixels_;
};

LightProbe::State state_of(float number) {
  using State = LightProbe::State;
  return number == 0 ? State::sound : number == 1 ? State::moved : State::filled;
}

std::size_t texels_of(const ProbeVolume& volume) {
  const auto [width, height] = size_of(volume);
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

void read_probes(const LayeredImage& image, ProbeVolume& volume) {
  const std::size_t count = volume.probes.size(), picture = texels_of(volume);
  const auto each = [&](const std::string& layer, const std::function<void(LightProbe&, const Vec3&)>& take) {
    const LayerReader values(image, layer, 3, picture);
    for (std::size_t i = 0; i < count; ++i) take(volume.probes[i], values.vec3(i));
  };
  for (std::size_t k = 0; k < probe_direction_count; ++k) {
    each(probe_direction_names()[k], [k](LightProbe& probe, const Vec3& v) { probe.irradiance[k] = v; });
    each(error_layer(k), [k](LightProbe& probe, const Vec3& v) { probe.standard_error[k] = v; });
  }
  for (std::size_t k = 0; k < 9; ++k)
    each("sh" + std::to_string(k), [k](LightProbe& probe, const Vec3& v) { probe.harmonics[k] = v; });
  each("position", [](LightProbe& probe, const Vec3& v) { probe.position = Vec3d(v); });
  const LayerReader validity(image, "validity", 1, picture), state(image, "state", 1, picture);
  for (std::size_t i = 0; i < count; ++i) {
    volume.probes[i].validity = validity[i][0];
    volume.probes[i].state = state_of(state[i][0]);
  }
}

void read_depths(const LayeredImage& image, int side, ProbeVolume& volume) {
  if (side < 1 || side > 64) fail(ExitCode::invalid_input, "maps of {} texels a side", side);
  const auto texels = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  const LayerReader values(image, "depth", 2, texels_of(volume) * texels);
  const auto width = static_cast<std::size_t>(size_of(volume).width);
  volume.depths = {side, std::vector<float>(volume.probes.size() * texels), {}};
  volume.depths.square = volume.depths.mean;
  for (std::size_t i = 0; i < volume.probes.size(); ++i) {
    for (std::size_t t = 0; t < texels; ++t) {
      const std::size_t row = i / width * std::size_t(side) + t / std::size_t(side),
                        column = i % width * std::size_t(side) + t % std::size_t(side);
      const auto texel = values[row * width * std::size_t(side) + column];
      volume.depths.mean[i * texels + t] = texel[0];
      volume.depths.square[i * texels + t] = texel[1];
    }
  }
}

/// Adds the file's name to what is wrong with it.
template <typename Work>
auto about_file(const fs::path& file, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    if (std::string_view(error.what()).find(file.filename().string()) != std::string_view::npos) throw;
    fail(error.code(), "{}: {}", file.string(), error.what());
  }
}

/// Probes are counted by then.
void read_tree(const json& entry, const fs::path& folder, ProbeVolume& volume) {
  const auto cells = entry.at("cells").get<std::int64_t>();
  if (!volume.grid || cells < 1 || cells > most_tree_cells)
    fail(ExitCode::invalid_input, "'{}' has a tree of {} cells{}", volume.name, cells,
         volume.grid ? "" : " and no grid");
  const fs::path file = file_at(entry, folder);
  about_file(file, [&] {
    volume.tree = tree_of(read_image(file), std::size_t(cells));
    check_tree(*volume.grid, *volume.tree, volume.probes.size());
  });
}

ProbeVolume volume_of(const json& entry, const fs::path& folder) {
  ProbeVolume volume;
  volume.name = entry.at("name").get<std::string>();
  if (entry.contains("grid")) volume.grid = grid_of(entry.at("grid"));
  const auto count = entry.at("probes").get<std::int64_t>();
  const bool has_tree = entry.contains("tree");
  const std::size_t of_grid = volume.grid ? volume.grid->size() : 1;
  if (count < 1 || count > most_probes || std::size_t(count) < of_grid ||
      (volume.grid && !has_tree && std::size_t(count) > of_grid))
    fail(ExitCode::invalid_input, "'{}' has {} probes, which does not fit its grid", volume.name, count);
  volume.probes.resize(std::size_t(count));
  if (has_tree) read_tree(entry.at("tree"), folder, volume);
  const fs::path file = file_at(entry, folder);
  about_file(file, [&] { read_probes(read_image(file), volume); });
  if (entry.contains("depth")) {
    const fs::path depth = file_at(entry.at("depth"), folder);
    about_file(depth,
               [&] { read_depths(read_image(depth), entry.at("depth").at("side").get<int>(), volume); });
  }
  return volume;
}

}  // namespace

std::vector<std::string> write_volumes(const fs::path& folder, const std::vector<ProbeVolume>& volumes,
                                       const json& about) {
  FileStems stems;
  json entries = json::array(), hashes = json::object();
  std::vector<std::string> names;
  for (const ProbeVolume& volume : volumes) {
    const std::string stem = stems.take(volume.name);
    const auto write = [&](const std::string& name, const LayeredImage& picture) {
      write_exr(folder / name, picture, Depth::full);
      hashes[name] = file_hash128_hex(folder / name);
      names.push_back(name);
    };
    write(stem + ".exr", picture_of(volume));
    if (volume.tree) write(stem + "_tree.exr", tree_picture(*volume.tree));
    if (volume.depths.side > 0) write(stem + "_depth.exr", depth_picture(volume));
    entries.push_back(json_of(volume, stem));
  }
  const json whole{{"format", volume_format}, {"about", about}, {"volumes", entries}, {"hashes", hashes}};
  write_atomically(folder / file_name, whole.dump(2) + '\n');
  names.emplace_back(file_name);
  return names;
}

StoredVolumes read_volumes(const fs::path& path) {
  const fs::path file = fs::is_directory(path) ? path / file_name : path;
  const json content = parse_json(read_text(file), file.string());
  return about_file(file, [&] {
    try {
      if (content.at("format") != volume_format)
        fail(ExitCode::unsupported, "format {} of another rnmbake", brief(content.at("format")));
      StoredVolumes stored;
      stored.about = content.at("about");
      for (const json& entry : content.at("volumes"))
        stored.volumes.push_back(volume_of(entry, file.parent_path()));
      return stored;
    } catch (const json::exception& problem) {
      fail(ExitCode::invalid_input, "{}", brief(problem));
    }
  });
}

}  // namespace rnmbake
