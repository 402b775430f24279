#include "pipeline/deliver/engines/raw_page.h"

#include "lightmap/half_range.h"
#include "pipeline/deliver/engine_target.h"

#include <string>

#include <half.h>
#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

void append_half(std::string& bytes, float value) {
  clamp_to_half(value);
  const unsigned short bits = half(value).bits();
  bytes.push_back(static_cast<char>(bits & 0xFF));
  bytes.push_back(static_cast<char>(bits >> 8));
}

std::string raw_texels(const FloatImage& image) {
  std::string bytes;
  bytes.reserve(image.texels() * 4 * sizeof(half));
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const Vec3 colour = vec3_at(image, x, y);
      for (int c = 0; c < 3; ++c) append_half(bytes, static_cast<float>(colour[c]));
      append_half(bytes, 1);
    }
  }
  return bytes;
}

}  // namespace

nlohmann::ordered_json write_raw_page(DeliveryFiles& files, std::size_t number, const Page& page) {
  nlohmann::ordered_json names = nlohmann::ordered_json::object();
  for (const Layer& layer : page.layers) {
    const std::string said = layer.name.empty() ? EngineTarget::flat : layer.name;
    const std::string file = fmt::format("page{}.{}.rgba16f", number, said);
    files.add(file, raw_texels(layer.pixels));
    names[said] = file;
  }
  return names;
}

}  // namespace rnmbake
