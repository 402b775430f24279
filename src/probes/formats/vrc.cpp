// VRC Light Volumes 2: three textures of half floats with bands 0 and 1, E/pi = L0 + L1 . n along Unity's
// world axes, as text assets; a script of the editor makes the volumes. The package's packer takes L1 for
// that of Bakery and multiplies it by min(0.565, L0 / |L1|), so that what is meant is divided by 0.565 here.
// Where |L1| > L0, as under a lone sun, the packer shortens it to L0 whatever is written.
#include "base/error.h"
#include "probes/formats/engine_box.h"
#include "probes/formats/makers.h"

namespace rnmbake {
namespace {

constexpr float packer_factor = 0.565F, vrc_y0 = 0.28209479F, vrc_y1 = 0.48860251F * 2 / 3;

/// L0 and, for each channel, L1 of one probe; Unity's axes.
struct BakedLinear {
  Vec3 l0;
  std::array<Vec3, 3> l1;
};

BakedLinear linear_of(const LightProbe& probe) {
  const std::array<Vec3, 9> harmonics = turned(unity_axes(), probe.harmonics);
  BakedLinear light{harmonics[0] * vrc_y0, {}};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto channel = static_cast<int>(c);
    light.l1[c] =
        Vec3(harmonics[3][channel], harmonics[1][channel], harmonics[2][channel]) * (vrc_y1 / packer_factor);
  }
  return light;
}

/// RGBA of texture 0, 1 or 2.
std::array<float, 4> texel_of(const BakedLinear& light, std::size_t texture) {
  const auto& [red, green, blue] = light.l1;
  if (texture == 0) return {light.l0.x, light.l0.y, light.l0.z, red.z};
  if (texture == 1) return {red.x, green.x, blue.x, green.z};
  return {red.y, green.y, blue.y, blue.z};
}

std::string asset(const std::string& name, const std::array<int, 3>& size, const std::string& texels) {
  std::string hex;
  for (const char byte : texels) hex += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  return fmt::format(
      "%YAML 1.1\n%TAG !u! tag:unity3d.com,2011:\n--- !u!117 &11700000\nTexture3D:\n"
      "  m_ObjectHideFlags: 0\n  m_CorrespondingSourceObject: {{fileID: 0}}\n"
      "  m_PrefabInstance: {{fileID: 0}}\n  m_PrefabAsset: {{fileID: 0}}\n  m_Name: {}\n"
      "  m_ImageContentsHash:\n    serializedVersion: 2\n    Hash: 00000000000000000000000000000000\n"
      "  m_ForcedFallbackFormat: 4\n  m_DownscaleFallback: 0\n  m_IsAlphaChannelOptional: 0\n"
      "  serializedVersion: 3\n  m_ColorSpace: 0\n  m_Format: 48\n  m_Width: {}\n  m_Height: {}\n"
      "  m_Depth: {}\n  m_MipCount: 1\n  m_DataSize: {}\n  m_TextureSettings:\n    serializedVersion: 2\n"
      "    m_FilterMode: 1\n    m_Aniso: 1\n    m_MipBias: 0\n    m_WrapU: 1\n    m_WrapV: 1\n"
      "    m_WrapW: 1\n  m_UsageMode: 0\n  m_IsReadable: 1\n  image data: {}\n  _typelessdata: {}\n"
      "  m_StreamData:\n    serializedVersion: 2\n    offset: 0\n    size: 0\n    path: \n",
      string_literal(name), size[0], size[1], size[2], texels.size(), texels.size(), hex);
}

std::string vrc_row(const std::string& stem, const EngineBox& box) {
  const auto number = [](double value) { return decimal(value) + "f"; };
  const Vec3d centre = box.centre(), size = box.size();
  const std::array<double, 4> turn = box.rotation();
  return fmt::format(
      "            new BakedVolume({}, new Vector3({}, {}, {}), new Quaternion({}, {}, {}, {}),\n"
      "                new Vector3({}, {}, {}), new Vector3Int({}, {}, {})),\n",
      string_literal(stem), number(centre.x), number(centre.y), number(centre.z), number(turn[0]),
      number(turn[1]), number(turn[2]), number(turn[3]), number(size.x), number(size.y), number(size.z),
      box.counts[0], box.counts[1], box.counts[2]);
}

}  // namespace

std::vector<FormatFile> vrc_files(std::span<const ProbeVolume> volumes) {
  const std::vector<std::string> stems = volume_stems(volumes);
  std::vector<FormatFile> files;
  std::string rows;
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    const EngineBox box = right_angled_box(volumes[i], unity_axes(), "vrc");
    std::vector<BakedLinear> light;
    for (const LightProbe& probe : volumes[i].probes) light.push_back(linear_of(probe));
    for (std::size_t texture = 0; texture < 3; ++texture) {
      std::string texels;
      for (int z = 0; z < box.counts[2]; ++z)
        for (int y = 0; y < box.counts[1]; ++y)
          for (int x = 0; x < box.counts[0]; ++x)
            for (const float value : texel_of(light[box.index(x, y, z)], texture)) append_half(texels, value);
      const std::string name = fmt::format("{}_{}", stems[i], texture);
      files.push_back({name + ".asset", asset(name, box.counts, texels)});
    }
    rows += vrc_row(stems[i], box);
  }
  FormatFile script = shipped_file("RnmbakeLightVolumes.cs");
  const std::string mark = "            // volumes\n";
  script.bytes.replace(script.bytes.find(mark), mark.size(), rows);
  files.push_back(script);
  return files;
}

}  // namespace rnmbake
