#include "pipeline/convert/convert.h"

#include "base/error.h"
#include "base/files.h"
#include "base/json.h"
#include "encoding/codecs/make_codec.h"
#include "encoding/encodings.h"
#include "lightmap/half_range.h"
#include "pipeline/convert/frame_rows.h"
#include "pipeline/lightmaps/lightmap_folder.h"
#include "pipeline/lightmaps/lightmap_rows.h"
#include "pipeline/lightmaps/lightmap_writer.h"
#include "pipeline/lightmaps/manifest_file.h"
#include "pipeline/run/hold_folder.h"

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

constexpr int band_rows = LightmapRows::band;
static_assert(band_rows > FrameRows::reach);  // frames are looked for in the next band, and no further

/// The decoder returns the very bakes which its numbers were made from. Of more than four, sh2 is a fit.
bool keeps_bakes(const LightmapMetadata& metadata) {
  const CodecOptions& codec = metadata.codec;
  if (codec.name == "sh2" && metadata.bases.size() > 4) return false;
  return holds_four_numbers(codec.name) && codec.range == 0;
}

/// The way back: each layer is the bake of one direction.
class BakesCodec : public TexelCodec {
 public:
  explicit BakesCodec(const BasisSet& directions) {
    for (const BasisDirection& basis : directions.directions) layers_.push_back(basis.name);
  }
  const std::vector<std::string>& layers() const override { return layers_; }
  bool can_rotate() const override { return false; }
  /// No normal is asked for: what is read is the layers.
  Vec3 decode(std::span<const Vec3> layers, const Vec3&) const override { return layers.front(); }

 private:
  EncodeCounts encode_texel(std::span<const Vec3> irradiance, std::span<Vec3> layers,
                            const TexelFrame&) const override {
    std::ranges::copy(irradiance, layers.begin());
    return {};
  }
  std::vector<std::string> layers_;
};

std::unique_ptr<const Codec> target_codec(const CodecOptions& options, const BasisSet& directions) {
  if (options.name == baked_codec) return std::make_unique<BakesCodec>(directions);
  return make_codec(options, directions);
}

/// E/pi of one texel at each direction of the codec that is fed.
class TexelSource {
 public:
  TexelSource(const LightmapMetadata& metadata, const BasisSet& directions) : directions_(directions) {
    if (metadata.is_baked()) {
      for (const BasisDirection& basis : directions.directions) layers_.push_back(exr_layer(basis.name));
      return;
    }
    codec_ = make_codec(metadata.codec, directions);
    for (const std::string& name : codec_->layers()) layers_.push_back(exr_layer(name));
  }

  /// Pictures of the source's layers among these rows. Throws Error(invalid_input), naming `file`.
  [[nodiscard]] std::vector<const FloatImage*> pictures(const LayeredImage& rows,
                                                        const std::string& file) const {
    std::vector<const FloatImage*> found;
    for (const std::string& name : layers_) {
      const Layer* layer = rows.find(name);
      if (layer == nullptr || layer->pixels.channels() != 3) {
        fail(ExitCode::invalid_input, "{} holds no RGB layer '{}', which its header promises; bake it again",
             file, name_of_exr_layer(name));
      }
      found.push_back(&layer->pixels);
    }
    return found;
  }

  /// `values`: the source's layers there, in their order; `stored`: the texel's frame in the space of these
  /// layers.
  void irradiance(std::span<const Vec3> values, const TexelFrame& stored, std::span<Vec3> out) const {
    if (!codec_) {
      std::ranges::copy(values, out.begin());
      return;
    }
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = codec_->decode(values, stored.stored(directions_.directions[i].direction));
  }

  [[nodiscard]] std::size_t layer_count() const { return layers_.size(); }

 private:
  const BasisSet& directions_;
  std::vector<std::string> layers_;
  std::unique_ptr<const Codec> codec_;  // none: the layers are the bakes themselves
};

bool holds_frames(const LayeredImage& image) {
  return image.find("tangent") != nullptr && image.find("normal") != nullptr;
}

/// One lightmap on its way from file to file.
class Conversion {
 public:
  Conversion(const LightmapPlace& place, const ConvertOptions& options)
      : options_(options),
        source_(opened(place, options)),
        directions_{source_.file(), source_.metadata().bases},
        codec_(target_codec(options.codec, directions_)),
        texels_(source_.metadata(), directions_),
        frames_(source_.metadata().green) {
    const LightmapMetadata& metadata = source_.metadata();
    from_world_ = metadata.space == "world";
    needs_frames_ = options.world || from_world_;
    if (metadata.normalize == Normalize::flat && options.codec.name != "flat" &&
        options.codec.name != "rnm-vrad")
      refuse(
          "its maps are scaled to the flat bake, and what they were is not in the file; bake without "
          "--normalize flat");
    if (needs_frames_ && !holds_frames(source_.header())) {
      refuse(
          "world space needs the tangent frames of its texels, which it does not hold; bake it with "
          "--frames");
    }
    if (options.world && !codec_->can_rotate())
      refuse("the encoding '" + options.codec.name +
             "' exists in tangent space only; leave out --space world");
  }

  ConvertSummary write(const fs::path& file, const std::function<void(double)>& progress) {
    LightmapWriter writer(file, output_header(), source_.width(), source_.height(), options_.depth,
                          options_.split);
    summary_.files = writer.files();
    LayeredImage next = read(0);
    for (int begin = 0; begin < source_.height(); begin += band_rows) {
      const LayeredImage rows = std::exchange(next, read(begin + band_rows));
      const int end = std::min(begin + band_rows, source_.height());
      writer.write(begin, end, converted(rows, begin, end, writer.channels()));
      if (progress) progress(double(end) / source_.height());
    }
    writer.commit();
    return std::move(summary_);
  }

 private:
  [[noreturn]] static void refuse(const std::string& file, const ConvertOptions& options,
                                  const std::string& why) {
    fail(ExitCode::unsupported, "{} cannot become '{}': {}", file, options.codec.name, why);
  }
  [[noreturn]] void refuse(const std::string& why) const { refuse(source_.file(), options_, why); }

  static LightmapRows opened(const LightmapPlace& place, const ConvertOptions& options) {
    LightmapRows source(place);
    if (const auto why = convert_obstacle(source.metadata())) refuse(source.file(), options, *why);
    return source;
  }

  /// The band from `begin` on; frames are known before the band above them is converted.
  LayeredImage read(int begin) {
    if (begin >= source_.height()) return {};
    LayeredImage rows = source_.read(begin, std::min(begin + band_rows, source_.height()));
    if (needs_frames_) frames_.add(begin, rows);
    return rows;
  }

  /// Layers of the result, without pixels, and its header.
  [[nodiscard]] LayeredImage output_header() const {
    LayeredImage header;
    for (const std::string& name : codec_->layers())
      header.layers.push_back({exr_layer(name), {"R", "G", "B"}, {}});
    for (const Layer& layer : source_.header().layers)
      if (is_kept(layer)) header.layers.push_back(layer);
    LightmapMetadata metadata = source_.metadata();
    metadata.set_codec(options_.codec);
    metadata.space = options_.world ? "world" : "tangent";
    write_metadata(metadata, header);
    return header;
  }

  [[nodiscard]] static bool is_kept(const Layer& layer) {
    return layer.name == "coverage" || layer.name == "tangent" || layer.name == "normal" ||
           layer.name == "validity";
  }

  std::vector<float> converted(const LayeredImage& rows, int begin, int end, std::size_t channels) {
    const auto pictures = texels_.pictures(rows, source_.file());
    const Layer* coverage = rows.find("coverage");
    std::vector<const Layer*> kept;
    for (const Layer& layer : rows.layers)
      if (is_kept(layer)) kept.push_back(&layer);
    frames_.drop_above(begin);
    const int width = source_.width();
    std::vector<float> out(std::size_t(end - begin) * width * channels);
    std::mutex mutex;
    tbb::parallel_for(tbb::blocked_range<int>(0, end - begin), [&](const tbb::blocked_range<int>& range) {
      ConvertCounts counts;
      RowBuffers row(texels_.layer_count(), directions_.directions.size(), codec_->layers().size(), width);
      for (int y = range.begin(); y < range.end(); ++y) {
        encode_row(pictures, y, begin + y, row);
        float* to = &out[std::size_t(y) * width * channels];
        for (int x = 0; x < width; ++x) {
          ConvertCounts own{.encode = row.counts[x], .without_frame = row.has_frame[x] ? 0U : 1U};
          to = write_layers(row.layers_of(x), own, to);
          for (const Layer* layer : kept) to = std::ranges::copy(layer->pixels.texel(x, y), to).out;
          if (coverage == nullptr || coverage->pixels.texel(x, y)[0] > 0.5F) counts += own;
        }
      }
      const std::scoped_lock lock(mutex);
      summary_.counts += counts;
    });
    return out;
  }

  /// A row of texels, as the codec takes them.
  struct RowBuffers {
    RowBuffers(std::size_t source_layers, std::size_t directions, std::size_t layers, int width)
        : values(source_layers),
          irradiance(directions * width),
          layers(layers * width),
          frames(width),
          has_frame(width),
          counts(width) {}

    [[nodiscard]] std::span<const Vec3> layers_of(int x) const {
      const std::size_t each = layers.size() / frames.size();
      return std::span(layers).subspan(x * each, each);
    }

    std::vector<Vec3> values;  // of one texel
    std::vector<Vec3> irradiance, layers;
    std::vector<TexelFrame> frames;
    std::vector<bool> has_frame;
    std::vector<EncodeCounts> counts;
  };

  /// `y`: the row within the pictures, `map_y`: within the lightmap.
  void encode_row(std::span<const FloatImage* const> pictures, int y, int map_y, RowBuffers& row) const {
    const std::size_t directions = directions_.directions.size();
    for (int x = 0; x < source_.width(); ++x) {
      for (std::size_t i = 0; i < pictures.size(); ++i) row.values[i] = vec3_at(*pictures[i], x, y);
      std::optional<TexelFrame> world;
      if (needs_frames_) world = frames_.nearest(x, map_y);
      const auto irradiance = std::span(row.irradiance).subspan(x * directions, directions);
      texels_.irradiance(row.values, from_world_ ? world.value_or(TexelFrame{}) : TexelFrame{}, irradiance);
      if (options_.world && !world)  // the same from everywhere: what is left of light without a frame
        std::ranges::fill(irradiance, irradiance.front());
      row.frames[x] = options_.world && world ? *world : TexelFrame{};
      row.has_frame[x] = world || !needs_frames_;
    }
    codec_->encode({row.irradiance, row.layers, row.frames}, row.counts);
  }

  float* write_layers(std::span<const Vec3> layers, ConvertCounts& counts, float* to) const {
    for (const Vec3& layer : layers) {
      for (int c = 0; c < 3; ++c, ++to) {
        *to = layer[c];
        if (options_.depth == Depth::half && clamp_to_half(*to)) ++counts.beyond_half;
      }
    }
    return to;
  }

  const ConvertOptions& options_;
  LightmapRows source_;
  BasisSet directions_;
  std::unique_ptr<const Codec> codec_;
  TexelSource texels_;
  FrameRows frames_;
  bool from_world_ = false, needs_frames_ = false;
  ConvertSummary summary_;
};

void write_converted_manifest(const fs::path& source, const std::vector<ConvertSummary>& converted,
                              const ConvertOptions& options, const fs::path& folder) {
  nlohmann::json manifest = read_manifest(source / "manifest.json");
  LightmapMetadata metadata;
  metadata.set_codec(options.codec);
  manifest["conventions"]["encoding"] = metadata.convention;
  manifest["conventions"]["space"] = options.world ? "world" : "tangent";
  if (!metadata.is_baked()) manifest["conventions"]["normalize"] = name_of(Normalize::none);
  for (nlohmann::json& object : manifest["objects"]) {
    const auto found = std::ranges::find(converted, object["key"].get<std::string>(), &ConvertSummary::key);
    object["files"] = found == converted.end() ? std::vector<std::string>{} : file_names(found->files);
  }
  write_atomically(folder / "manifest.json", manifest.dump(2) + "\n");
}

}  // namespace

ConvertCounts& ConvertCounts::operator+=(const ConvertCounts& other) {
  encode += other.encode;
  beyond_half += other.beyond_half;
  without_frame += other.without_frame;
  return *this;
}

std::optional<std::string> convert_obstacle(const LightmapMetadata& metadata) {
  if (metadata.units != "E/pi") return "its units are '" + metadata.units + "'; E/pi is needed";
  if (metadata.handedness != "right") return "its frame is " + metadata.handedness + "-handed; bake it again";
  if (metadata.is_baked()) return std::nullopt;
  if (!metadata.is_encoded())
    return "its convention is '" + metadata.convention + "', which is not known; convert what rnmbake baked";
  if (keeps_bakes(metadata)) return std::nullopt;
  return "'" + metadata.convention + "' does not keep what was baked; convert the baked lightmap";
}

ConvertSummary convert_lightmap(const LightmapPlace& place, const ConvertOptions& options,
                                const fs::path& file, const std::function<void(double)>& progress) {
  ConvertSummary summary = Conversion(place, options).write(file, progress);
  summary.key = place.key;
  return summary;
}

std::vector<ConvertSummary> convert_lightmaps(const fs::path& source, const ConvertOptions& options,
                                              const fs::path& folder,
                                              const std::function<void(double, std::string)>& progress) {
  const LightmapFolder found = open_lightmaps(source);
  const FolderLock lock = hold_folder(folder);
  std::error_code unreadable;
  if (fs::equivalent(found.single_file ? source.parent_path() / "." : source, folder, unreadable)) {
    fail(ExitCode::usage, "{} holds what is converted, which would be replaced; name another folder with -o",
         folder.string());
  }
  std::vector<ConvertSummary> converted;
  for (const LightmapPlace& place : found.places) {
    const auto share = [&](double of_file) {
      if (progress) progress((double(converted.size()) + of_file) / double(found.places.size()), place.key);
    };
    fs::path name = place.files.front().stem();
    if (place.files.size() > 1) name = name.stem();  // of "floor.flat.exr"
    converted.push_back(convert_lightmap(place, options, folder / name.concat(".exr"), share));
  }
  if (!found.single_file) write_converted_manifest(source, converted, options, folder);
  return converted;
}

}  // namespace rnmbake
