#include "base/error.h"
#include "base/math.h"
#include "base/text.h"
#include "cli/ssbump/ssbump_tool_flags.h"
#include "cli/ssbump/ssbump_tools.h"
#include "cli/ssbump/weight_range_json.h"
#include "ssbump/map/direction_map.h"
#include "ssbump/map/normals.h"
#include "ssbump/map/weight_ranges.h"
#include "ssbump/map/weights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

struct InfoOptions {
  SsbumpInputFlags input;
  bool json = false;
};

struct NamedRange {
  std::string name;
  WeightRange range;
};

std::vector<WeightRange> ranges_of(const FloatImage& weights) {
  WeightRanges ranges;
  ranges.add(weights);
  return ranges.ranges();
}

std::vector<NamedRange> named_ranges(const SsbumpPicture& picture) {
  const std::vector<WeightRange> ranges = ranges_of(picture.weights);
  std::vector<NamedRange> all;
  for (std::size_t c = 0; c < ranges.size(); ++c) {
    if (c == SsbumpWeights::up && picture.metadata.alpha != SsbumpAlpha::up) continue;
    if (c == SsbumpWeights::ambient && picture.metadata.alpha != SsbumpAlpha::ao) continue;
    all.push_back({ssbump_channel_names[c], ranges[c]});
  }
  return all;
}

std::vector<NamedRange> named_ranges(const DirectionMap& map) {
  const std::vector<WeightRange> ranges = ranges_of(map.weights);
  std::vector<NamedRange> all;
  for (std::size_t c = 0; c < ranges.size(); ++c)
    all.push_back({map.metadata.set.directions[c].name, ranges[c]});
  return all;
}

/// Angles of bent normals to the surface's, mean and largest, degrees.
std::pair<double, double> tilt_of(const FloatImage& weights) {
  const FloatImage normals = bent_normals(weights);
  double sum = 0, most = 0;
  for (std::size_t at = 2; at < normals.data().size(); at += 3) {
    const double tilt = std::acos(std::clamp<double>(normals.data()[at], -1, 1)) * 180 / pi;
    sum += tilt;
    most = std::max(most, tilt);
  }
  return {sum / static_cast<double>(normals.texels()), most};
}

void print_json(const InfoOptions& options, const SsbumpPicture& picture) {
  nlohmann::ordered_json json;
  const SsbumpMetadata& metadata = picture.metadata;
  json["file"] = options.input.file.string();
  json["width"] = picture.weights.width();
  json["height"] = picture.weights.height();
  json["storage"] = picture.storage;
  json["metadata"] = picture.knows_itself;
  json["scale"] = name_of(metadata.scale);
  json["flat"] = flat_value(metadata.scale);
  json["handedness"] = name_of(metadata.handed);
  json["alpha"] = name_of(metadata.alpha);
  if (picture.knows_itself) json["power"] = metadata.power;
  if (picture.knows_itself) json["method"] = metadata.method;
  if (picture.knows_itself) json["settings"] = metadata.settings;
  for (const auto& [name, range] : named_ranges(picture)) json["weights"][name] = json_of(range);
  const auto [mean, most] = tilt_of(picture.weights);
  json["bent_normal_tilt"] = {{"mean", mean}, {"greatest", most}};
  std::cout << json.dump(2) << '\n';
}

void print(const InfoOptions& options, const SsbumpPicture& picture) {
  const SsbumpMetadata& metadata = picture.metadata;
  const auto row = [](const char* name, const std::string& value) {
    if (!value.empty()) std::cout << printable(fmt::format("{:<12} {}", name, value)) << '\n';
  };
  row("file", fmt::format("{}, {} x {}, {}", options.input.file.string(), picture.weights.width(),
                          picture.weights.height(), picture.storage));
  row("scale",
      fmt::format("{}: the open surface stores {:.4f}", name_of(metadata.scale), flat_value(metadata.scale)));
  row("handedness",
      fmt::format("{}: channels are right, {}", name_of(metadata.handed),
                  metadata.handed == Handed::right ? "upper left, lower left" : "lower left, upper left"));
  row("alpha", name_of(metadata.alpha));
  if (picture.knows_itself) row("power", fmt::format("{:g}", metadata.power));
  row("method", metadata.method);
  row("settings", metadata.settings);
  std::cout << fmt::format("\n{:<12} {:>8} {:>8} {:>8}   (1 is open)\n", "weight", "least", "mean",
                           "greatest");
  for (const auto& [name, range] : named_ranges(picture))
    std::cout << fmt::format("{:<12} {:>8.4f} {:>8.4f} {:>8.4f}\n", name, range.least, range.mean,
                             range.greatest);
  const auto [mean, most] = tilt_of(picture.weights);
  std::cout << fmt::format("\nBent normals lean {:.1f} degrees on average, {:.1f} at most.\n", mean, most);
}

void print_directions_json(const InfoOptions& options, const DirectionMap& map) {
  nlohmann::ordered_json json;
  json["file"] = options.input.file.string();
  json["width"] = map.weights.width();
  json["height"] = map.weights.height();
  json["storage"] = map.storage;
  json["metadata"] = true;
  json["set"] = map.metadata.set.name;
  for (const auto& [name, v] : map.metadata.set.directions) json["basis"][name] = {v.x, v.y, v.z};
  json["fit"] = map.metadata.fit;
  json["method"] = map.metadata.method;
  json["settings"] = map.metadata.settings;
  for (const auto& [name, range] : named_ranges(map)) json["weights"][name] = json_of(range);
  std::cout << json.dump(2) << '\n';
}

void print_directions(const InfoOptions& options, const DirectionMap& map) {
  const auto row = [](const char* name, const std::string& value) {
    std::cout << printable(fmt::format("{:<12} {}", name, value)) << '\n';
  };
  row("file", fmt::format("{}, {} x {}, {}", options.input.file.string(), map.weights.width(),
                          map.weights.height(), map.storage));
  row("set", fmt::format("{}: {} directions, E = sum of s_i LM_i", map.metadata.set.name,
                         map.metadata.set.directions.size()));
  row("handedness", "right");
  row("fit", map.metadata.fit);
  row("method", map.metadata.method);
  row("settings", map.metadata.settings);
  std::cout << fmt::format("\n{:<12} {:>8} {:>8} {:>8}   direction\n", "weight", "least", "mean", "greatest");
  const auto all = named_ranges(map);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [name, range] = all[i];
    const Vec3& v = map.metadata.set.directions[i].direction;
    std::cout << fmt::format("{:<12} {:>8.4f} {:>8.4f} {:>8.4f}   {:.3f} {:.3f} {:.3f}\n", name, range.least,
                             range.mean, range.greatest, v.x, v.y, v.z);
  }
}

int run_info(const InfoOptions& options) {
  if (const auto map = read_direction_map(options.input.file)) {
    const SsbumpInputFlags& input = options.input;
    if (!input.scale.empty() || !input.handed.empty() || !input.alpha.empty())
      fail(ExitCode::usage, "{} says of itself what it holds; leave out --scale, --handed and --alpha",
           input.file.string());
    options.json ? print_directions_json(options, *map) : print_directions(options, *map);
    return static_cast<int>(ExitCode::ok);
  }
  const SsbumpPicture picture = options.input.read();
  if (options.json) {
    print_json(options, picture);
  } else {
    print(options, picture);
  }
  return static_cast<int>(ExitCode::ok);
}

}  // namespace

std::function<int()> add_ssbump_info(CLI::App& ssbump) {
  auto options = std::make_shared<InfoOptions>();
  CLI::App* command = ssbump.add_subcommand("info", "What a map holds: conventions, weights, bent normals");
  options->input.add_to(*command);
  command->add_flag("--json", options->json, "one JSON object instead of the table");
  return [options] { return run_info(*options); };
}

}  // namespace rnmbake
