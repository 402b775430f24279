#include "pipeline/lightmaps/deliver_lightmap.h"

#include "base/error.h"
#include "base/events/log_event.h"
#include "base/files.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/object_notes.h"
#include "base/text.h"
#include "lightmap/layout.h"
#include "pipeline/run/hold_folder.h"

#include <algorithm>
#include <utility>

namespace rnmbake {
namespace {

MergeOptions merge_options(const OutputSettings& output, const LightmapHeader& header) {
  MergeOptions options;
  options.normalize = output.normalize;
  options.depth = output.depth;
  options.dilate = header.dilate;
  options.repair = output.repair;
  return options;
}

void warn_about(const std::string& key, const MergeCounts& counts, bool repaired) {
  if (counts.non_finite > 0) {
    log::warn("{}: {} NaN or infinite{}", key, counted(counts.non_finite, "texel"),
              repaired ? ", repaired" : "; --repair fills them from their neighbours");
  }
  if (counts.beyond_half > 0) {
    log::warn("{}: {} beyond 65504 clamped; --depth float keeps what is above", key,
              counted(counts.beyond_half, "value"));
  }
}

/// Throws Error(tasks_failed) where no covered texel is finite: repairs need sound neighbours.
void refuse_if_nothing_is_a_number(const std::string& key, const MergeCounts& counts) {
  if (counts.covered_texels == 0 || counts.non_finite < counts.covered_texels) return;
  fail(ExitCode::tasks_failed,
       "{}: all of its {} texels are NaN or infinite: look for a lamp, a sky or a material of the scene with "
       "such a value",
       key, counts.covered_texels);
}

std::vector<std::string> write(const OutputSettings& output, const std::string& stem, LayeredImage image) {
  std::vector<std::string> files;
  const auto save = [&](const std::string& name, const LayeredImage& content) {
    write_exr(output.dir / name, content, output.depth);
    files.push_back(name);
  };
  if (output.layout == OutputSettings::Layout::layers) {
    save(stem + ".exr", image);
  } else {
    for (const LayerFile& file : one_file_per_layer(std::move(image)))
      save(stem + "." + file.name + ".exr", file.image);
  }
  return files;
}

}  // namespace

std::size_t count_failed(const std::vector<Delivery>& deliveries) {
  return static_cast<std::size_t>(std::count_if(
      deliveries.begin(), deliveries.end(),
      [](const Delivery& delivery) { return !delivery || std::holds_alternative<NotDelivered>(*delivery); }));
}

NotDelivered not_delivered(const std::string& key, const std::string& reason, const std::string& line) {
  log::event(log::Level::error, "failed", line, {{"object", key}, {"reason", reason}});
  return NotDelivered{reason};
}

void warn_of_black(const std::vector<Target>& targets, const std::vector<Delivery>& deliveries) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < deliveries.size(); ++i) {
    const auto* delivered = deliveries[i] ? std::get_if<Delivered>(&*deliveries[i]) : nullptr;
    if (delivered != nullptr && delivered->counts.black == delivered->counts.covered_texels)
      names.push_back(targets[i].key);
  }
  if (names.empty()) return;
  log::warn(
      "{}: {} of {} lightmaps are all black: are these objects buried, do their faces look away from the "
      "light, or is it too weak?",
      first_names(names), names.size(), deliveries.size());
}

bool has_error_layers(const OutputSettings& output) {
  using When = OutputSettings::StandardErrors;
  return output.standard_errors == When::always ||
         (output.standard_errors == When::when_float && output.depth == Depth::full);
}

FolderLock prepare_output(const OutputSettings& output, const RunSettings& run) {
  if (output.dir.empty())
    fail(ExitCode::usage, "no output folder: pass -o DIR, or set dir in [output] of the project file");
  make_folders(output.dir);
  AtomicFile(output.dir / "manifest.json").write(std::string(1 << 16, ' '));  // never committed
  return hold_folder(output.dir, run.lock_wait);
}

Delivered deliver_lightmap(const TargetBakes& bakes, const LightmapHeader& header,
                           const OutputSettings& output, ExtraLayers extra) {
  const MergeOptions options = merge_options(output, header);
  MergedLightmap merged = merge(bakes, options);
  refuse_if_nothing_is_a_number(header.metadata.object, merged.counts);
  add_extra_layers(std::move(extra), options, merged.image);
  warn_about(header.metadata.object, merged.counts, output.repair);
  LightmapMetadata metadata = header.metadata;
  for (const BasisBake& basis : bakes.bases) metadata.bases.push_back({basis.name, basis.direction});
  metadata.repaired = merged.counts.repaired > 0;
  write_metadata(metadata, merged.image);
  Delivered delivered{write(output, header.stem, std::move(merged.image)), merged.counts, metadata.samples};
  for (const std::string& name : delivered.files)
    delivered.hashes.push_back(file_hash128_hex(output.dir / name));
  return delivered;
}

}  // namespace rnmbake
