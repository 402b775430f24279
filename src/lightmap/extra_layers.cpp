#include "lightmap/extra_layers.h"

#include "encoding/encodings.h"
#include "lightmap/fill.h"
#include "lightmap/half_range.h"

#include <algorithm>
#include <utility>

namespace rnmbake {
namespace {

const std::vector<std::string> rgb{"R", "G", "B"};

void fit(FloatImage& picture, Depth depth) {
  if (depth == Depth::half) clamp_to_half(picture);
}

}  // namespace

void add_extra_layers(ExtraLayers extra, const MergeOptions& options, LayeredImage& image) {
  std::vector<Layer> layers;
  if (options.normalize == Normalize::none) {
    for (auto& [basis, picture] : extra.standard_errors) {
      fit(picture, options.depth);
      layers.push_back({basis + "_stderr", rgb, std::move(picture)});
    }
  }
  const Layer* coverage = image.find("coverage");
  for (std::size_t i = 0; i < extra.sh.size(); ++i) {
    fit(extra.sh[i], options.depth);
    if (coverage != nullptr) dilate(extra.sh[i], coverage->pixels, options.dilate);
    layers.push_back({std::string(sh_layers[i]), rgb, std::move(extra.sh[i])});
  }
  if (!extra.validity.empty()) layers.push_back({"validity", {""}, std::move(extra.validity)});
  const auto place = std::ranges::find(image.layers, "coverage", &Layer::name);
  image.layers.insert(place, std::make_move_iterator(layers.begin()), std::make_move_iterator(layers.end()));
}

}  // namespace rnmbake
