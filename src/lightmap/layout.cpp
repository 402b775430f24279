#include "lightmap/layout.h"

#include "encoding/encodings.h"

#include <utility>

namespace rnmbake {

std::vector<LayerFile> one_file_per_layer(LayeredImage lightmap) {
  std::vector<LayerFile> files;
  for (Layer& layer : lightmap.layers) {
    LayerFile file;
    file.name = name_of_exr_layer(layer.name);
    file.image.attributes = lightmap.attributes;
    file.image.attributes[layer_attribute] = file.name;
    if (layer.channels == std::vector<std::string>{""}) layer.channels = {"Y"};
    layer.name.clear();
    file.image.layers.push_back(std::move(layer));
    files.push_back(std::move(file));
  }
  return files;
}

}  // namespace rnmbake
