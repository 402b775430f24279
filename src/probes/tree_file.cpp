#include "probes/tree_file.h"

#include "base/error.h"

#include <cmath>

namespace rnmbake {
namespace {

constexpr std::size_t numbers = 9;  // of each cell
constexpr float most_number = 1 << 24;

}  // namespace

int square_width(std::size_t texels) {
  return static_cast<int>(std::ceil(std::sqrt(double(texels))));
}

int square_height(std::size_t texels) {
  const auto width = static_cast<std::size_t>(square_width(texels));
  return static_cast<int>((texels + width - 1) / width);
}

LayeredImage tree_picture(const ProbeTree& tree) {
  const int width = square_width(tree.cells.size());
  Layer layer{"cell",
              {"c0", "c1", "c2", "c3", "c4", "c5", "c6", "c7", "children"},
              FloatImage(width, square_height(tree.cells.size()), numbers)};
  for (std::size_t cell = 0; cell < tree.cells.size(); ++cell) {
    const auto at = static_cast<int>(cell);
    const auto texel = layer.pixels.texel(at % width, at / width);
    for (std::size_t k = 0; k < 8; ++k) texel[k] = static_cast<float>(tree.cells[cell].corners[k]);
    texel[8] = static_cast<float>(tree.cells[cell].children);
  }
  LayeredImage image;
  image.layers.push_back(std::move(layer));
  return image;
}

ProbeTree tree_of(const LayeredImage& image, std::size_t cells) {
  const Layer* layer = image.find("cell");
  if (layer == nullptr || layer->pixels.channels() != int(numbers))
    fail(ExitCode::invalid_input, "it lacks the layer 'cell' with c0 to c7 and children");
  const int width = square_width(cells);
  if (layer->pixels.width() != width || layer->pixels.height() != square_height(cells)) {
    fail(ExitCode::invalid_input, "it has {} x {} texels, which does not fit {} cells", layer->pixels.width(),
         layer->pixels.height(), cells);
  }
  for (const float value : layer->pixels.data()) {
    if (!(value >= 0) || value >= most_number || value != std::floor(value))
      fail(ExitCode::invalid_input, "the layer 'cell' has {}, which is no number of a probe or a cell",
           value);
  }
  ProbeTree tree;
  tree.cells.resize(cells);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const auto texel = std::span(layer->pixels.data()).subspan(cell * numbers, numbers);
    for (std::size_t k = 0; k < 8; ++k) tree.cells[cell].corners[k] = static_cast<std::uint32_t>(texel[k]);
    tree.cells[cell].children = static_cast<std::uint32_t>(texel[8]);
  }
  return tree;
}

}  // namespace rnmbake
