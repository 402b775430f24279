#include "pipeline/ssbump/ssbump_run.h"

#include "base/clock.h"
#include "base/error.h"
#include "base/log.h"
#include "blender/blender_session.h"
#include "pipeline/ssbump/direction_files.h"
#include "process/stop.h"
#include "ssbump/generate/albedo.h"
#include "ssbump/heights/bilateral.h"
#include "ssbump/map/direction_map.h"
#include "ssbump/map/normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <span>

namespace rnmbake {
namespace {

constexpr int rows_at_once = 64;                           // written at a time
constexpr double edge_share = 0.03;                        // of the range of heights
constexpr double read_until = 0.05, filtered_until = 0.2;  // shares of the progress

const char* name_of(SsbumpMethod method) {
  constexpr std::array names{"horizon", "trace", "cone"};
  return names[static_cast<std::size_t>(method)];
}

void check_stop() {
  if (StopRequest::requested()) throw Interrupted{StopRequest::signal()};
}

/// Output files of one run, each written under a temporary name: a class, since all of them must stay open
/// until the last is whole and write() puts them in place together.
class SsbumpOutputs {
 public:
  SsbumpOutputs(const SsbumpRunOptions& options, Progress& progress)
      : options_(options), progress_(progress) {}

  SsbumpRunSummary write() {
    check_outputs();
    step("read", [&] { read(); });
    if (options_.filter_radius > 0) step("filter", [&] { filter(); });
    step("generate", [&] { generate_files(); });
    for (const auto& file : files_) file->commit();
    if (map_) {
      map_->commit();
      summary_.ranges = map_->ranges();
    }
    return std::move(summary_);
  }

 private:
  void step(const char* name, const std::function<void()>& work) {
    const double begun = steady_clock().now();
    work();
    summary_.seconds.emplace_back(name, steady_clock().now() - begun);
    check_stop();
  }

  /// Refuses unknown file endings and depths before the work, not after it.
  void check_outputs() const {
    (void)storage_of(options_.output.file, options_.output.bits);
    for (const auto& file : {options_.normal, options_.dump_height})
      if (!file.empty()) (void)storage_of(file, options_.output.bits);
  }

  void read() {
    progress_.update(0, "reading " + options_.input.string());
    ReadHeights read = read_heights(options_.input, options_.heights);
    field_ = std::move(read.field);
    if (read.lowest == read.highest) {
      log::warn("{}: all heights of channel {} are {:g}; the map is flat", options_.input.string(),
                read.channel, read.lowest);
    }
    read.field = {};
    summary_.heights = std::move(read);
    summary_.width = field_.width();
    summary_.height = field_.height();
    if (!options_.albedo.empty()) albedo_ = read_albedo(options_.albedo, field_.width(), field_.height());
  }

  void filter() {
    const ReadHeights& heights = summary_.heights;
    const double range = double(heights.highest) - heights.lowest;
    summary_.edge = options_.filter_edge.value_or(edge_share * range);
    const BilateralOptions bilateral_options{options_.filter_radius,
                                             static_cast<float>(summary_.edge * std::abs(heights.texels)),
                                             options_.generate.threads};
    field_.heights = bilateral(field_, bilateral_options, [&](double share) {
      progress_.update(read_until + share * (filtered_until - read_until), "filtering");
    });
  }

  void generate_files() {
    if (!options_.dump_height.empty()) dump_height();
    if (!options_.normal.empty()) write_normals();
    if (options_.directions) return generate_directions();
    map_ = std::make_unique<SsbumpFile>(options_.output, metadata(), field_.width(), field_.height());
    if (options_.baked) {
      progress_.update(filtered_until, "Cycles");
      write_weights(0, options_.baked(field_).image);
    } else {
      generate_map();
    }
    check_stop();
  }

  void generate_directions() {
    const DirectionOptions& directions = *options_.directions;
    const Storage storage = storage_of(options_.output.file, options_.output.bits);
    const DirectionMapMetadata form{directions.set, directions.sign == WeightSign::free ? "free" : "positive",
                                    "trace",
                                    settings_of_heights() + fmt::format(", rays {}", directions.rays)};
    auto& writer = files_.emplace_back(std::make_unique<PictureWriter>(
        options_.output.file, direction_map_form(form, field_.width(), field_.height(), storage)));
    summary_.ranges = write_directions(
        field_, directions, *writer,
        [&](double share) { progress_.update(filtered_until + share * (1 - filtered_until), "generating"); },
        [] { return StopRequest::requested(); });
    check_stop();
  }

  void generate_map() {
    GenerateOptions generate = options_.generate;
    if (!albedo_.empty()) generate.albedo_map = &albedo_;
    generate_rows(
        field_, generate,
        [&](int first_row, const SsbumpWeights& rows) {
          summary_.azimuths = std::max(summary_.azimuths, rows.azimuths);
          summary_.rmse = std::max(summary_.rmse, rows.rmse);
          write_weights(first_row, rows.image);
        },
        [&](double share) { progress_.update(filtered_until + share * (1 - filtered_until), "generating"); },
        [] { return StopRequest::requested(); });
  }

  void write_weights(int first_row, const FloatImage& rows) {
    if (albedo_.empty() || !options_.modulate) return map_->write(first_row, rows);
    FloatImage modulated = rows;
    modulate_rows(modulated, albedo_, first_row);
    map_->write(first_row, modulated);
  }

  [[nodiscard]] std::string settings_of_heights() const {
    std::string settings = fmt::format("height {:g} texels", summary_.heights.texels);
    if (options_.filter_radius > 0) settings += fmt::format(", filter {}", options_.filter_radius);
    return settings;
  }

  [[nodiscard]] SsbumpMetadata metadata() const {
    SsbumpMetadata metadata;
    const GenerateOptions& generate = options_.generate;
    metadata.power = generate.method == SsbumpMethod::cone ? 1 : generate.power;
    metadata.method = options_.baked ? "blender" : name_of(generate.method);
    metadata.settings = settings_of_heights();
    if (generate.method != SsbumpMethod::horizon || options_.baked)
      metadata.settings += fmt::format(", rays {}", generate.rays);
    else if (generate.azimuths > 0)
      metadata.settings += fmt::format(", azimuths {}", generate.azimuths);
    else
      metadata.settings += fmt::format(", error {:g}", generate.error);
    if (generate.bounces > 0) metadata.settings += fmt::format(", bounces {}", generate.bounces);
    return metadata;
  }

  /// Filtered heights as the file had them: the full range of an integer format, or its floats.
  void dump_height() {
    const Storage storage = storage_of(options_.dump_height, options_.output.bits);
    PictureForm form{field_.width(), field_.height(), {"Y"}, storage, {}};
    form.attributes["ImageDescription"] = fmt::format("heights; 1 is {:g} texels", summary_.heights.texels);
    const double texels = summary_.heights.texels;
    const auto to_file = static_cast<float>(texels != 0 ? 1 / texels : 0);
    write_rows(options_.dump_height, form, [&](int begin, int end) {
      FloatImage rows(field_.width(), end - begin, 1);
      std::ranges::transform(std::span(field_.heights.texel(0, begin).data(), rows.data().size()),
                             rows.data().begin(), [&](float height) { return height * to_file; });
      return rows;
    });
  }

  void write_normals() {
    const Storage storage = storage_of(options_.normal, options_.output.bits);
    const bool y_down = options_.output.encoding.handed == Handed::left;
    write_rows(options_.normal, normal_map_form(field_.width(), field_.height(), storage, y_down),
               [&](int begin, int end) {
                 FloatImage normals = height_normals(field_, begin, end);
                 pack_normals(normals, y_down);
                 return normals;
               });
  }

  void write_rows(const std::filesystem::path& file, const PictureForm& form,
                  const std::function<FloatImage(int, int)>& rows_of) {
    auto& writer = files_.emplace_back(std::make_unique<PictureWriter>(file, form));
    for (int begin = 0; begin < form.height; begin += rows_at_once) {
      const int end = std::min(begin + rows_at_once, form.height);
      writer->write(begin, end, rows_of(begin, end).data());
      check_stop();
    }
  }

  const SsbumpRunOptions& options_;
  Progress& progress_;
  SsbumpRunSummary summary_;
  HeightField field_;
  FloatImage albedo_;
  std::vector<std::unique_ptr<PictureWriter>> files_;
  std::unique_ptr<SsbumpFile> map_;
};

}  // namespace

SsbumpRunSummary run_ssbump(const SsbumpRunOptions& options, Progress& progress) {
  return SsbumpOutputs(options, progress).write();
}

}  // namespace rnmbake
