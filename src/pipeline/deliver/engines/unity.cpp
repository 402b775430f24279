#include "pipeline/deliver/engines/unity.h"

#include "base/hash.h"
#include "image/picture_rows.h"
#include "pipeline/deliver/engine_axes.h"
#include "pipeline/deliver/engines/shipped_files.h"
#include "shaders/engines.h"

#include <utility>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {

namespace {

using nlohmann::ordered_json;

/// What Unity's importer is told: Lightmap (6) is decoded by Unity's shaders, Default (0) is data. High
/// quality is BC6H and BC7 on desktops. The identifier is the same after every bake of the same objects.
std::string picture_meta(const std::string& identifier, int texture_type) {
  return fmt::format(
      "fileFormatVersion: 2\nguid: {}\nTextureImporter:\n  serializedVersion: 11\n  mipmaps:\n    "
      "enableMipMap: 0\n"
      "    sRGBTexture: 0\n  isReadable: 0\n  textureSettings:\n    serializedVersion: 2\n    filterMode: 1\n"
      "    wrapU: 1\n    wrapV: 1\n    wrapW: 1\n  nPOTScale: 0\n  alphaUsage: 0\n  textureType: {}\n"
      "  platformSettings:\n  - serializedVersion: 3\n    buildTarget: DefaultTexturePlatform\n"
      "    maxTextureSize: 16384\n    textureFormat: -1\n    textureCompression: 2\n",
      identifier, texture_type);
}

/// t of Unity's x, y and z as R, G and B, of the map that holds those of Blender's.
FloatImage along_unity_axes(const FloatImage& blender) {
  FloatImage unity(blender.width(), blender.height(), 3);
  for (std::size_t texel = 0; texel < blender.data().size(); texel += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const float t = blender.data()[texel + static_cast<std::size_t>(unity_axes[k].blender)];
      unity.data()[texel + k] = unity_axes[k].reversed ? 1 - t : t;
    }
  }
  return unity;
}

}  // namespace

const std::vector<std::string>& Unity::encodings() const {
  static const std::vector<std::string> names{"sh2", "zh3", "geomerics", flat};
  return names;
}

void Unity::pack(CodecOptions& codec) const {
  codec.range = 2;
  codec.bits = 8;
  codec.mono = true;
}

ordered_json Unity::write_page(DeliveryFiles& files, std::size_t number, Page page) const {
  ordered_json names = ordered_json::object();
  if (page.layers.size() > 1) {
    const FloatImage direction = along_unity_axes(page.layers[1].pixels);
    const std::string file = fmt::format("page{}.dir.png", number);
    PictureWriter writer(files.add(file),
                         {direction.width(), direction.height(), {"R", "G", "B"}, Storage::u8, {}});
    writer.write(0, direction.height(), direction.data());
    writer.commit();
    page.layers.pop_back();
    names["dir"] = file;
  }
  names.update(EngineTarget::write_page(files, number, std::move(page)));
  return names;
}

void Unity::add_files(DeliveryFiles& files, ordered_json& record) const {
  std::string objects;
  for (const ordered_json& object : record.at("objects"))
    objects += object.at("key").get<std::string>() + "\n";
  for (const ordered_json& page : record.at("pages")) {
    for (const auto& [layer, file] : page.at("layers").items()) {
      const std::string name = file.get<std::string>();
      files.add(name + ".meta", picture_meta(hash128_hex(name + "\n" + objects), layer == "dir" ? 0 : 6));
    }
  }
  record["axes"] = "(-x, z, -y) of Blender";
  for (const auto& [name, text] : embedded_unity_files()) files.add(name, text);
  const std::string encoding = record.at("encoding");
  if (encoding != flat)
    files.add(fmt::format("rnmbake_{}.cginc", encoding), shader_text(engine_named("unity"), {encoding}));
}

}  // namespace rnmbake
