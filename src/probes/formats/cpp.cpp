// For an engine of one's own: a file of numbers, and shipped/rnmbake_probes.h, which says what is where and
// looks light up in it.
#include "base/error.h"
#include "probes/formats/makers.h"

namespace rnmbake {
namespace {

std::string numbers_of(const ProbeVolume& volume) {
  std::string bytes = "RNMPROBE";
  append_u32(bytes, 1);  // version
  for (std::size_t k = 0; k < 3; ++k)
    append_u32(bytes, volume.grid ? static_cast<std::uint32_t>(volume.grid->counts[k]) : 0);
  append_u64(bytes, volume.probes.size());
  const ProbeGrid grid = volume.grid.value_or(ProbeGrid());
  for (int c = 0; c < 3; ++c) append_double(bytes, grid.first[c]);
  for (const Vec3d& step : grid.steps)
    for (int c = 0; c < 3; ++c) append_double(bytes, step[c]);
  for (const LightProbe& probe : volume.probes) {
    for (int c = 0; c < 3; ++c) append_float(bytes, static_cast<float>(probe.position[c]));
    append_float(bytes, probe.validity);
    for (const Vec3& coefficient : probe.harmonics)
      for (int c = 0; c < 3; ++c) append_float(bytes, coefficient[c]);
  }
  return bytes;
}

}  // namespace

std::vector<FormatFile> cpp_files(std::span<const ProbeVolume> volumes) {
  const std::vector<std::string> stems = volume_stems(volumes);
  std::vector<FormatFile> files;
  for (std::size_t i = 0; i < volumes.size(); ++i)
    files.push_back({stems[i] + ".rnmprobes", numbers_of(volumes[i])});
  files.push_back(shipped_file("rnmbake_probes.h"));
  return files;
}

}  // namespace rnmbake
