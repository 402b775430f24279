// image/channels.h - what the channels of a picture are for, by their names: colours, vectors, single values.
#pragma once

#include "image/layered_exr.h"

#include <string>
#include <string_view>
#include <vector>

namespace rnmbake {

/// What one layer of a file holds: "left" with R, G, B of "left.R", "left.G", "left.B"; "" of "R".
struct ChannelGroup {
  std::string layer;
  std::vector<std::string> channels;
  std::vector<int> index;  // [channels] -> place among the file's channels
};

/// In the order of the layers' names; a name of several letters without a dot is a layer with one channel "".
[[nodiscard]] std::vector<ChannelGroup> channel_groups(const std::vector<std::string>& names);

/// Files list their channels by the alphabet; the same with R, G, B, X, Y, Z first in this order and alpha
/// last.
[[nodiscard]] ChannelGroup in_usual_order(const ChannelGroup& group);

/// Where channels with these one-letter names are, in this order, in any case; empty where one is missing.
[[nodiscard]] std::vector<int> places_of(const std::vector<std::string>& channels, std::string_view letters);

/// File channels of the colour: R, G, B. Of the plain layer, or else of the only one that has them. Empty
/// where none has; throws Error(invalid_input) that names the layers where several have, ending in `remedy`.
[[nodiscard]] std::vector<int> colour_channels(const std::vector<std::string>& names, const std::string& file,
                                               const std::string& remedy);

/// "R, G, B and 2 more", for messages.
[[nodiscard]] std::string listed(const std::vector<std::string>& channels);

/// The channels at these places, in their order.
[[nodiscard]] FloatImage picked(const FloatImage& pixels, const std::vector<int>& places);

/// Where a picture holds a vector for each texel.
struct VectorSource {
  const Layer* layer = nullptr;
  std::vector<int> places;  // x, y and, unless left out, z
  bool is_signed = false;   // else 0 to 1 stands for -1 to 1
};

/// X, Y, Z rather than R, G, B, and a layer that is called normal rather than another; then the plain one.
/// `two_channel`: z is left out, and a picture that declares grey and alpha holds x and y. Throws
/// Error(invalid_input) naming the channels where there is no vector, or more than one.
[[nodiscard]] VectorSource vector_source(const LayeredImage& picture, const std::string& file,
                                         bool two_channel = false);

/// A value below 0 at the source's places in these pixels of its layer: what makes 0 to 1 signed.
[[nodiscard]] bool has_negative(const FloatImage& pixels, const VectorSource& source);

}  // namespace rnmbake
