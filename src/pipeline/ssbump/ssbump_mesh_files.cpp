#include "pipeline/ssbump/ssbump_mesh_files.h"

#include "ssbump/map/normals.h"

#include <algorithm>
#include <memory>
#include <vector>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

PictureForm height_form(const FloatImage& heights, Storage storage) {
  PictureForm form{heights.width(), heights.height(), {"Y"}, storage, {}};
  form.attributes["ImageDescription"] = std::string("heights over the low surface");
  return form;
}

/// Least and greatest, of covered texels.
std::pair<float, float> range_of(const MeshOcclusion& maps) {
  float least = 0, greatest = 0;
  for (std::size_t i = 0; i < maps.height.data().size(); ++i) {
    if (maps.found.data()[i] == 0) continue;
    least = std::min(least, maps.height.data()[i]);
    greatest = std::max(greatest, maps.height.data()[i]);
  }
  return {least, greatest};
}

}  // namespace

SsbumpRunSummary write_ssbump_mesh(const SsbumpMesh& mesh, const SsbumpRunOptions& options) {
  const MeshOcclusion& maps = mesh.maps;
  const int width = maps.weights.image.width(), height = maps.weights.image.height();
  std::vector<std::unique_ptr<PictureWriter>> files;
  const auto write = [&](const std::filesystem::path& file, const PictureForm& form,
                         const FloatImage& image) {
    files.emplace_back(std::make_unique<PictureWriter>(file, form))->write(0, height, image.data());
  };
  SsbumpRunSummary summary;
  summary.width = width;
  summary.height = height;
  const auto [least, greatest] = range_of(maps);
  summary.heights.lowest = least;
  summary.heights.highest = greatest;
  summary.heights.channel = "mesh";
  if (!options.normal.empty()) {
    const bool y_down = options.output.encoding.handed == Handed::left;
    FloatImage normals = maps.normal;
    pack_normals(normals, y_down);
    write(options.normal,
          normal_map_form(width, height, storage_of(options.normal, options.output.bits), y_down), normals);
  }
  if (!options.dump_height.empty()) {
    const Storage storage = storage_of(options.dump_height, options.output.bits);
    FloatImage heights = maps.height;
    const bool scales = storage == Storage::u8 || storage == Storage::u16;
    for (float& value : heights.data())
      if (scales) value = greatest > least ? (value - least) / (greatest - least) : 0;
    write(options.dump_height, height_form(heights, storage), heights);
  }
  SsbumpMetadata metadata;
  metadata.power = options.generate.power;
  metadata.method = "mesh";
  metadata.settings = fmt::format("rays {}, cage {:g}", options.generate.rays, mesh.cage);
  SsbumpFile map(options.output, metadata, width, height);
  map.write(0, maps.weights.image);
  for (const auto& file : files) file->commit();
  map.commit();
  summary.ranges = map.ranges();
  return summary;
}

}  // namespace rnmbake
