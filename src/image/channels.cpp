#include "image/channels.h"

#include "base/error.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

int rank_of(const std::string& channel) {
  static constexpr std::string_view order = "RGBXYZ";
  if (channel == "A") return static_cast<int>(order.size()) + 1;
  const auto found = channel.size() == 1 ? order.find(channel[0]) : std::string_view::npos;
  return static_cast<int>(found == std::string_view::npos ? order.size() : found);
}

char upper(char c) {
  return static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
}

/// `rnm0.R` -> rnm0, R; `R` -> "", R; `coverage` -> coverage, "" (see Layer).
std::pair<std::string, std::string> split_name(const std::string& name) {
  const auto dot = name.rfind('.');
  if (dot != std::string::npos) return {name.substr(0, dot), name.substr(dot + 1)};
  if (name.size() == 1) return {"", name};
  return {name, ""};
}

bool is_called_normal(const std::string& layer) {
  std::string name = layer.substr(layer.rfind('.') + 1);
  std::ranges::transform(name, name.begin(), upper);
  return name == "NORMAL" || name == "NORMALS";
}

std::string described(const std::string& layer, const std::vector<std::string>& channels) {
  return layer.empty() ? listed(channels) : fmt::format("{} ({})", layer, listed(channels));
}

/// A vector that a layer may hold, and how much speaks for it.
struct Candidate {
  VectorSource source;
  int rank = 0;
};

std::optional<Candidate> candidate_in(const Layer& layer, bool two_channel) {
  static const std::vector<const char*> three{"XYZ", "RGB", "XY", "RG"}, two{"XY", "RG", "YA", "IA"};
  for (const char* letters : two_channel ? two : three) {
    const auto places = places_of(layer.channels, letters);
    if (places.empty()) continue;
    const bool by_name = letters[0] == 'X';
    const int rank =
        (by_name ? 4 : 0) + (is_called_normal(layer.name) ? 2 : 0) + (layer.name.empty() ? 1 : 0);
    return Candidate{{&layer, places, by_name}, rank};
  }
  return std::nullopt;
}

}  // namespace

std::vector<ChannelGroup> channel_groups(const std::vector<std::string>& names) {
  std::map<std::string, ChannelGroup> groups;
  for (std::size_t i = 0; i < names.size(); ++i) {
    auto [layer, channel] = split_name(names[i]);
    ChannelGroup& group = groups[layer];
    group.layer = std::move(layer);
    group.channels.push_back(std::move(channel));
    group.index.push_back(static_cast<int>(i));
  }
  std::vector<ChannelGroup> list;
  list.reserve(groups.size());
  for (auto& [layer, group] : groups) list.push_back(std::move(group));
  return list;
}

ChannelGroup in_usual_order(const ChannelGroup& group) {
  std::vector<std::size_t> order(group.channels.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t place) { return rank_of(group.channels[place]); });
  ChannelGroup ordered{group.layer, {}, {}};
  for (const std::size_t place : order) {
    ordered.channels.push_back(group.channels[place]);
    ordered.index.push_back(group.index[place]);
  }
  return ordered;
}

std::vector<int> places_of(const std::vector<std::string>& channels, std::string_view letters) {
  std::vector<int> places;
  for (const char letter : letters) {
    const auto found = std::ranges::find_if(channels, [&](const std::string& channel) {
      return channel.size() == 1 && upper(channel[0]) == letter;
    });
    if (found == channels.end()) return {};
    places.push_back(static_cast<int>(found - channels.begin()));
  }
  return places;
}

std::vector<int> colour_channels(const std::vector<std::string>& names, const std::string& file,
                                 const std::string& remedy) {
  std::vector<int> colour;
  std::vector<std::string> layers;
  for (const ChannelGroup& group : channel_groups(names)) {
    const auto places = places_of(group.channels, "RGB");
    if (places.empty()) continue;
    layers.push_back(described(group.layer, group.channels));
    colour.clear();
    for (const int place : places) colour.push_back(group.index[static_cast<std::size_t>(place)]);
    if (group.layer.empty()) return colour;  // the first by name
  }
  if (layers.size() > 1)
    fail(ExitCode::invalid_input, "{} holds several pictures: {}; {}", file, fmt::join(layers, ", "), remedy);
  return colour;
}

std::string listed(const std::vector<std::string>& channels) {
  constexpr std::size_t most = 8;
  std::string text = fmt::format(
      "{}", fmt::join(channels.begin(),
                      channels.begin() + static_cast<std::ptrdiff_t>(std::min(most, channels.size())), ", "));
  return channels.size() > most ? text + fmt::format(" and {} more", channels.size() - most) : text;
}

FloatImage picked(const FloatImage& pixels, const std::vector<int>& places) {
  FloatImage result(pixels.width(), pixels.height(), static_cast<int>(places.size()));
  std::size_t at = 0;
  for (int y = 0; y < pixels.height(); ++y) {
    for (int x = 0; x < pixels.width(); ++x) {
      const auto texel = pixels.texel(x, y);
      for (const int place : places) result.data()[at++] = texel[static_cast<std::size_t>(place)];
    }
  }
  return result;
}

VectorSource vector_source(const LayeredImage& picture, const std::string& file, bool two_channel) {
  std::optional<Candidate> best;
  std::vector<std::string> rivals, all;
  for (const Layer& layer : picture.layers) {
    all.push_back(described(layer.name, layer.channels));
    const auto candidate = candidate_in(layer, two_channel);
    if (!candidate || (best && candidate->rank < best->rank)) continue;
    if (best && candidate->rank > best->rank) rivals.clear();
    rivals.push_back(all.back());
    best = candidate;
  }
  if (!best) {
    fail(ExitCode::invalid_input,
         "{} holds no normals: its channels are {}; give a picture with R, G, B or X, Y, Z (z may be left "
         "out)",
         file, fmt::join(all, ", "));
  }
  if (rivals.size() > 1) {
    fail(ExitCode::invalid_input,
         "{} may hold several normal maps: {}; save the one that is meant as a picture of its own", file,
         fmt::join(rivals, ", "));
  }
  best->source.is_signed |= has_negative(best->source.layer->pixels, best->source);
  return best->source;
}

bool has_negative(const FloatImage& pixels, const VectorSource& source) {
  for (std::size_t at = 0; at < pixels.data().size(); at += static_cast<std::size_t>(pixels.channels())) {
    if (std::ranges::any_of(source.places, [&](int place) { return pixels.data()[at + place] < 0; }))
      return true;
  }
  return false;
}

}  // namespace rnmbake
