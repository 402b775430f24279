#include "pipeline/deliver/engines/source.h"

#include "base/error.h"
#include "base/text.h"
#include "image/vtf.h"
#include "pipeline/deliver/engines/shipped_files.h"
#include "pipeline/deliver/page_texels.h"
#include "shaders/engines.h"

#include <utility>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr std::size_t largest_file = std::size_t{32} << 20;  // that Source 2013 loads

constexpr const char* straight_up = "straight_up";  // a normal map

std::array<float, 3> mean_of(const FloatImage& image) {
  std::array<double, 3> sum{};
  for (std::size_t i = 0; i < image.data().size(); ++i) sum[i % 3] += image.data()[i];
  std::array<float, 3> mean{};
  for (std::size_t c = 0; c < 3; ++c) mean[c] = static_cast<float>(sum[c] / double(image.texels()));
  return mean;
}

void add_texture(DeliveryFiles& files, const std::string& file, const FloatImage& image) {
  const EncodedTexels texels = encode_texels(TexelFormat::rgba16_sfloat, image);
  files.add(file, vtf_of({image.width(), image.height(), texels.bytes, mean_of(image)}));
}

/// What vrad's scale makes of them.
FloatImage mean_of(const std::vector<Layer>& layers) {
  FloatImage mean = layers[0].pixels;
  for (std::size_t i = 0; i < mean.data().size(); ++i)
    mean.data()[i] =
        (layers[0].pixels.data()[i] + layers[1].pixels.data()[i] + layers[2].pixels.data()[i]) / 3;
  return mean;
}

FloatImage normal_straight_up() {
  FloatImage image(4, 4, 3);
  for (std::size_t i = 0; i < image.data().size(); ++i) image.data()[i] = i % 3 == 2 ? 1.0F : 0.5F;
  return image;
}

std::string flat_material(const std::string& texture) {
  return fmt::format("\"UnlitGeneric\"\n{{\n\t\"$basetexture\" \"{}\"\n}}\n", texture);
}

/// `page`: a texture's name without its layer.
std::string directional_material(const std::string& page, const std::string& normal_map) {
  std::string text = "\"screenspace_general\"\n{\n\t\"$pixshader\" \"rnmbake_light_ps20\"\n";
  const auto line = [&](const std::string& key, const std::string& value) {
    text += fmt::format("\t\"{}\" \"{}\"\n", key, value);
  };
  line("$basetexture", page + "_rnm0");
  line("$texture1", page + "_rnm1");
  line("$texture2", page + "_rnm2");
  line("$texture3", normal_map);
  for (const char* slot : {"basetexture", "texture1", "texture2", "texture3"})
    line(fmt::format("$linearread_{}", slot), "1");
  for (const char* channel : {"x", "y", "z"}) line(fmt::format("$c0_{}", channel), "1.0");
  for (const char* on : {"$x360appchooser", "$softwareskin", "$translucent"}) line(on, "1");
  return text + "}\n";
}

}  // namespace

std::string source_texture_folder(const fs::path& folder) {
  const fs::path whole = fs::absolute(folder / "x").lexically_normal().parent_path();
  std::string below;
  bool is_below = false;
  for (const fs::path& step : whole) {
    if (lower_case(step.string()) == "materials") {
      is_below = true;
      below.clear();
    } else if (is_below) {
      below += step.string() + "/";
    }
  }
  return is_below ? below : whole.filename().string() + "/";
}

const std::vector<std::string>& Source::encodings() const {
  static const std::vector<std::string> names{"rnm-vrad", flat};
  return names;
}

ordered_json Source::write_page(DeliveryFiles& files, std::size_t number, Page page) const {
  const int width = page.coverage.width(), height = page.coverage.height();
  if (vtf_size(width, height) > largest_file)
    fail(ExitCode::unsupported,
         "page {} is {} x {} texels, {} MiB as .vtf, and Source loads 32 MiB at most; pass --pages 1024",
         number, width, height, vtf_size(width, height) >> 20);
  ordered_json names = ordered_json::object();
  const auto add = [&](const std::string& layer, const FloatImage& image) {
    const std::string file = fmt::format("page{}_{}.vtf", number, layer);
    add_texture(files, file, image);
    names[layer] = file;
  };
  if (page.layers.size() > 1) add(flat, mean_of(page.layers));
  for (const Layer& layer : page.layers) add(PageWriter::record_name(layer), layer.pixels);
  return names;
}

void Source::add_files(DeliveryFiles& files, ordered_json& record) const {
  const std::string folder = source_texture_folder(files.folder());
  if (folder.find('"') != std::string::npos)
    fail(ExitCode::unsupported, "{}: materials of Source cannot name a folder with '\"' in it; rename it",
         files.folder().string());
  const bool is_directional = record.at("encoding") != flat;
  for (std::size_t number = 0; number < record.at("pages").size(); ++number) {
    const std::string page = fmt::format("page{}", number);
    files.add(page + "_flat.vmt", flat_material(folder + page + "_flat"));
    if (is_directional) files.add(page + ".vmt", directional_material(folder + page, folder + straight_up));
  }
  if (!is_directional) return;
  add_texture(files, std::string(straight_up) + ".vtf", normal_straight_up());
  const char* const green = record.at("green") == "y-up" ? "-1.0" : "1.0";
  for (const auto& [name, text] : embedded_source_files())
    files.add(name,
              fmt::format("static const float page_green = {};  // normal maps have green down\n\n{}\n{}",
                          green, shader_text(engine_named("source"), {"rnm"}), text));
}

}  // namespace rnmbake
