#include "pipeline/deliver/deliver.h"

#include "base/error.h"
#include "base/math.h"
#include "base/read_file.h"
#include "base/version.h"
#include "encoding/codecs/make_codec.h"
#include "lightmap/mips.h"
#include "pipeline/convert/convert.h"
#include "pipeline/deliver/delivery_files.h"
#include "pipeline/deliver/flat_picture.h"
#include "pipeline/deliver/glb.h"
#include "pipeline/deliver/lightmap_uvs.h"
#include "pipeline/lightmaps/manifest_file.h"
#include "pipeline/run/hold_folder.h"

#include <algorithm>
#include <bit>
#include <map>
#include <utility>

#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

ordered_json pair_of(const Imath::V2d& pair) {
  return {pair.x, pair.y};
}

void check_objects(const nlohmann::json& manifest, const fs::path& file) {
  for (const nlohmann::json& object : manifest.at("objects")) {
    if (object.at("status") != "baked") continue;
    if (!object.value("part", "").empty())
      fail(ExitCode::unsupported,
           "{}: '{}' is a part of an object (--split), and the .glb has one lightmap for each object; bake "
           "without "
           "--split",
           file.string(), object.at("key").get<std::string>());
    if (object.value("object_in_scene", "").empty() || object.value("uv_index", -1) != 1)
      fail(ExitCode::unsupported, "{}: the saved scene has no UVs of '{}'; bake with --save-scene always",
           file.string(), object.at("key").get<std::string>());
  }
}

/// To sides that are powers of two.
void round_up(std::vector<RectSize>& pages) {
  for (RectSize& page : pages) {
    page.width = static_cast<int>(std::bit_ceil(static_cast<unsigned>(page.width)));
    page.height = static_cast<int>(std::bit_ceil(static_cast<unsigned>(page.height)));
  }
}

/// How the pages are to be written. Throws as check().
PageForm page_form(const DeliverOptions& options) {
  const std::vector<PageFormat>& known = options.engine->formats();
  const PageFormat own = known.empty() ? PageFormat::exr : known.front();
  PageForm form{.format = options.format.value_or(own), .zstd = options.zstd};
  if (options.format && std::ranges::find(known, form.format) == known.end()) {
    std::vector<std::string> names;
    for (const PageFormat format : known) names.emplace_back(name_of(format));
    fail(ExitCode::unsupported, "{} does not read pages as {}; {}", options.engine->name(),
         name_of(form.format),
         known.empty() ? "leave --page-format out" : fmt::format("choose of {}", fmt::join(names, ", ")));
  }
  form.padding = options.padding;
  const int most = mips_within(form.padding);
  form.mips = options.mips.value_or(is_ktx2(form.format) ? most : 0);
  if (!is_ktx2(form.format) && (form.mips > 0 || form.zstd))
    fail(ExitCode::usage, "{} has no {}; choose --page-format ktx2-rgba16f, or leave the flag out",
         name_of(form.format), form.mips > 0 ? "mipmaps" : "compression by Zstandard");
  if (form.mips > most)
    fail(ExitCode::usage, "{} mipmaps reach past a padding of {} texels; pass --page-padding {}", form.mips,
         form.padding, 1 << form.mips);
  return form;
}

/// What one delivery knows while it is made.
class EngineDelivery {
 public:
  EngineDelivery(BlenderSession& session, const fs::path& lightmaps, const DeliverOptions& options,
                 const std::function<void(double, std::string)>& progress)
      : session_(session),
        options_(options),
        progress_(progress),
        target_(*options.engine),
        encoding_(options.encoding.empty() ? target_.encodings().front() : options.encoding),
        lightmaps_(lightmaps),
        folder_(open_lightmaps(lightmaps)),
        manifest_(read_manifest(lightmaps / "manifest.json")),
        files_(session.new_folder("delivery"), session.settings().output.dir),
        writer_(files_, page_form(options)) {
    if (folder_.places.empty())
      fail(ExitCode::invalid_input, "{} holds no lightmap: none was baked", lightmaps.string());
  }

  DeliverySummary make() {
    const PageLimits limits{options_.side, writer_.form().padding, target_.pages_alike()};
    const std::vector<std::string> objects = saved_objects();
    say(0, "lightmap UVs");
    summary_.layout = lay_out_pages(folder_, limits, lightmap_uvs(session_, objects));
    if (target_.powers_of_two()) round_up(summary_.layout.pages);
    const std::vector<Page> flat = flat_pages();
    write_encoded_pages(flat);
    write_flat_pictures(flat);
    write_scene(objects);
    target_.add_files(files_, record_);
    summary_.written = files_.put_in_place(std::move(record_));
    summary_.files = files_.names();
    return std::move(summary_);
  }

 private:
  [[nodiscard]] const PageLayout& layout() const { return summary_.layout; }

  /// Names in the saved scene of what stands for the folder's maps, in their order.
  [[nodiscard]] std::vector<std::string> saved_objects() const {
    std::map<std::string, std::string> by_key;
    for (const nlohmann::json& object : manifest_.at("objects"))
      by_key[object.at("key").get<std::string>()] = object.value("object_in_scene", "");
    std::vector<std::string> names;
    for (const LightmapPlace& place : folder_.places) names.push_back(by_key.at(place.key));
    return names;
  }

  void say(double share, const std::string& what) const {
    if (progress_) progress_(share, what);
  }

  /// Of the bakes themselves. They are what the .glb shows, whatever the pages hold.
  std::vector<Page> flat_pages() {
    if (load_lightmap(folder_.places.front()).image.find("") == nullptr)
      fail(ExitCode::unsupported, "{} has no flat bake, which the .glb shows; add 'flat' to --bases",
           lightmaps_.string());
    std::vector<Page> flat;
    for (std::size_t page = 0; page < layout().pages.size(); ++page)
      flat.push_back(compose_page(folder_, layout(), page, {""}));
    return flat;
  }

  void write_encoded_pages(const std::vector<Page>& flat) {
    const bool is_flat = encoding_ == EngineTarget::flat;
    LightmapFolder source;
    std::vector<std::string> layers;
    if (!is_flat) {
      source = convert();
      const LoadedLightmap first = load_lightmap(source.places.front());
      layers = make_codec(codec_, {first.file, first.metadata.bases})->layers();
      green_ = first.metadata.green;
    }
    for (std::size_t page = 0; page < layout().pages.size(); ++page) {
      say(0.5 + 0.2 * double(page) / double(layout().pages.size()), fmt::format("page {}", page));
      const RectSize size = layout().pages[page];
      pages_.push_back(
          {{"width", size.width},
           {"height", size.height},
           {"covered", layout().covered_share(page)},
           {"layers",
            write_page(page, is_flat ? flat[page] : compose_page(source, layout(), page, layers))}});
    }
    summary_.form = writer_.form();
    summary_.losses = writer_.losses();
    for (const PageLoss& loss : summary_.losses) {
      ordered_json& page = pages_[loss.page];
      page["format"] = name_of(writer_.form().format);
      page["mips"] = writer_.form().mips;
      page["loss"][loss.layer] = record_of(loss.lost);
    }
  }

  ordered_json write_page(std::size_t number, Page page) {
    return target_.formats().empty() ? target_.write_page(files_, number, std::move(page))
                                     : writer_.write(number, page);
  }

  /// All lightmaps, in the encoding.
  LightmapFolder convert() {
    codec_.name = encoding_;
    target_.pack(codec_);
    const fs::path folder = session_.new_folder("converted");
    (void)convert_lightmaps(lightmaps_, {.codec = codec_, .world = target_.in_world(), .depth = Depth::half},
                            folder, [&](double share, const std::string& key) { say(0.5 * share, key); });
    return open_lightmaps(folder);
  }

  /// For the .glb.
  void write_flat_pictures(const std::vector<Page>& flat) {
    white_ = white_of(flat);
    const fs::path folder = session_.new_folder("pictures");
    for (std::size_t page = 0; page < flat.size(); ++page) {
      pictures_.push_back(folder / fmt::format("page{}.png", page));
      const PictureMetrics lost = write_flat_picture(pictures_.back(), flat[page], white_);
      pages_[page]["flat_picture"] = {{"white", white_}};
      pages_[page]["flat_picture"].update(record_of(lost));
    }
  }

  void write_scene(const std::vector<std::string>& objects) {
    say(0.8, "scene.glb");
    record_ = {{"schema_version", 1},      {"generator", fmt::format("rnmbake {}", version)},
               {"scene", "scene.glb"},     {"encoding", encoding_},
               {"units", "E/pi"},          {"space", target_.in_world() ? "world" : "tangent"},
               {"green", name_of(green_)}, {"texcoord", 1},
               {"pages", pages_}};
    const GlbRequest request{pictures_, pi * white_, record_, options_.lights};
    const GlbResult glb = write_glb(session_, layout(), objects, request, files_.add("scene.glb"));
    summary_.notes = glb.notes;
    ordered_json list = ordered_json::array();
    for (const PagedMap& map : layout().maps) {
      const auto found = glb.nodes.find(map.key);
      if (found == glb.nodes.end()) continue;
      const RectSize page = layout().pages[map.page];
      list.push_back({{"key", map.key},
                      {"node", found->second.node},
                      {"name", found->second.name},
                      {"mesh", found->second.mesh},
                      {"page", map.page},
                      {"scale", pair_of(map.scale(page))},
                      {"offset", pair_of(map.offset(page))}});
    }
    record_["objects"] = std::move(list);
    record_["notes"] = glb.notes;
  }

  BlenderSession& session_;
  const DeliverOptions& options_;
  const std::function<void(double, std::string)>& progress_;
  const EngineTarget& target_;
  std::string encoding_;
  CodecOptions codec_;
  fs::path lightmaps_;
  LightmapFolder folder_;
  nlohmann::json manifest_;
  DeliveryFiles files_;
  PageWriter writer_;
  DeliverySummary summary_;
  ordered_json pages_ = ordered_json::array(), record_;
  std::vector<fs::path> pictures_;
  Green green_ = Green::y_up;
  float white_ = 1;
};

}  // namespace

fs::path scene_to_deliver(const fs::path& lightmaps) {
  const fs::path file = lightmaps / "manifest.json";
  (void)open_lightmaps(lightmaps);
  const nlohmann::json manifest = read_manifest(file);
  const auto saved = file_inside(lightmaps, manifest.value("scene_with_uvs", ""));
  if (!saved || !fs::is_regular_file(*saved))
    fail(ExitCode::unsupported, "{} has no scene with the lightmaps' UVs; bake with --save-scene always",
         lightmaps.string());
  check_objects(manifest, file);
  return *saved;
}

void check(const DeliverOptions& options) {
  const std::vector<std::string>& known = options.engine->encodings();
  if (!options.encoding.empty() && std::ranges::find(known, options.encoding) == known.end())
    fail(ExitCode::unsupported, "there is no decoder of '{}' for {}; choose of {}", options.encoding,
         options.engine->name(), fmt::join(known, ", "));
  (void)page_form(options);
}

DeliverySummary deliver(BlenderSession& session, const fs::path& lightmaps, const DeliverOptions& options,
                        const std::function<void(double, std::string)>& progress) {
  check(options);
  const FolderLock lock = hold_folder(session.settings().output.dir, session.settings().run.lock_wait);
  return EngineDelivery(session, lightmaps, options, progress).make();
}

}  // namespace rnmbake
