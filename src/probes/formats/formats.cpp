#include "probes/formats/formats.h"

#include "base/error.h"
#include "base/files.h"
#include "base/names.h"
#include "probes/formats/makers.h"

#include <algorithm>
#include <array>

namespace rnmbake {

std::span<const ProbeFormat> probe_formats() {
  static constexpr std::array<ProbeFormat, 7> formats{{
      {"threejs", "three.js' LightProbeGrid with a loader and a page to look at",
       "light_probes.json, STEM.bin, probes.js, index.html", threejs_files},
      {"bevy", "Bevy's IrradianceVolume", "STEM.vxgi.ktx2, probes.rs", bevy_files},
      {"cpp", "a file and a C++ header that looks light up in it", "STEM.rnmprobes, rnmbake_probes.h",
       cpp_files},
      {"gltf", "points with the light in their attributes", "light_probes.glb", gltf_files},
      {"vrc", "VRC Light Volumes 2 of VRChat",
       "STEM_0.asset, STEM_1.asset, STEM_2.asset, RnmbakeLightVolumes.cs", vrc_files},
      {"godot", "Godot 4's LightmapGIData", "STEM.tres", godot_files},
      {"unity", "Unity's light probes", "light_probes_unity.json, RnmbakeLightProbes.cs", unity_files},
  }};
  return formats;
}

const ProbeFormat& probe_format_named(const std::string& name) {
  std::vector<std::string> names;
  std::string list;
  for (const ProbeFormat& format : probe_formats()) {
    if (format.name == name) return format;
    names.emplace_back(format.name);
    list += (list.empty() ? "" : ", ") + names.back();
  }
  fail(ExitCode::usage, "no format of probes is called '{}'{}; there are {}", name, did_you_mean(name, names),
       list);
}

std::vector<std::filesystem::path> write_probe_format(const std::string& name,
                                                      std::span<const ProbeVolume> volumes,
                                                      const std::filesystem::path& folder) {
  for (const ProbeVolume& volume : volumes) {
    if (volume.tree)
      fail(ExitCode::unsupported, "'{}' is a tree of probes, and {} takes regular boxes: leave --error out",
           volume.name, name);
  }
  const std::vector<FormatFile> files = probe_format_named(name).make(volumes);
  make_folders(folder);
  std::vector<std::filesystem::path> paths;
  for (const FormatFile& file : files) {
    paths.push_back(folder / file.name);
    write_atomically(paths.back(), file.bytes);
  }
  return paths;
}

}  // namespace rnmbake
