#include "report/document.h"
#include "report/finding.h"
#include "report/html_fill.h"
#include "report/html_parts.h"
#include "report/maps.h"
#include "report/pack.h"
#include "report/write.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace rnmbake {
namespace {

using json = nlohmann::ordered_json;

constexpr int noise_bits = 5;  // 1.6 %: a standard error need not be known better
constexpr int smallest_map = 8;

/// Textures of one size that are unpacked together.
struct Bundle {
  std::vector<std::string> names;
  std::vector<FloatImage> images;
  std::vector<int> kept_bits;

  void add(const char* name, const FloatImage& image, int limit, int bits) {
    if (image.empty()) return;
    names.emplace_back(name);
    images.push_back(shrink(image, limit));
    kept_bits.push_back(bits);
  }
};

/// Data elements of the page, with the index of their textures.
class Blobs {
 public:
  json add(const Bundle& bundle) {
    std::vector<PackedPicture> pictures;
    json channels = json::array();
    for (std::size_t i = 0; i < bundle.images.size(); ++i) {
      pictures.push_back({&bundle.images[i], bundle.kept_bits[i]});
      channels.push_back(bundle.images[i].channels());
    }
    if (pictures.empty()) return nullptr;
    const std::string id = "blob-" + std::to_string(count_++);
    text_ += "<script type=\"text/plain\" id=\"" + id + "\">" + pack(pictures) + "</script>\n";
    return {{"id", id},
            {"width", bundle.images.front().width()},
            {"height", bundle.images.front().height()},
            {"names", bundle.names},
            {"channels", channels}};
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
  int count_ = 0;
};

/// Sides of the maps: of each object's first basis, and of the others.
struct Limits {
  int first = 256, others = 256;
};

json add_maps(const Report& report, const Limits& limits, Blobs& blobs) {
  json objects = json::array();
  for (const ObjectComparison& object : report.objects) {
    json list = json::array();
    for (const BasisMaps& maps : object.maps) {
      const int limit = list.empty() ? limits.first : limits.others;
      Bundle bundle;
      bundle.add("candidate", maps.candidate, limit, 10);
      bundle.add("reference", maps.reference, limit, 10);
      bundle.add("candidate_noise", maps.candidate_noise, limit, noise_bits);
      bundle.add("reference_noise", maps.reference_noise, limit, noise_bits);
      json entry = blobs.add(bundle);
      if (entry.is_null()) continue;
      entry["basis"] = maps.basis;
      list.push_back(std::move(entry));
    }
    objects.push_back(std::move(list));
  }
  return objects;
}

json add_views(const Report& report, int limit, Blobs& blobs) {
  json views = json::array();
  for (const ViewComparison& view : report.views) {
    json list = json::array();
    for (const ViewPicture& picture : view.pictures) {
      Bundle bundle;
      bundle.add("picture", picture.picture, limit, 10);
      list.push_back(blobs.add(bundle));
    }
    views.push_back(std::move(list));
  }
  return views;
}

std::string page_with(const Report& report, const Limits& limits, int view_limit) {
  Blobs blobs;
  json pictures{{"objects", add_maps(report, limits, blobs)},
                {"views", add_views(report, view_limit, blobs)}};
  return filled(embedded_files(embedded_report(), "page.html"),
                {{"head", page_head(report.title, "")},
                 {"title", escaped(report.title)},
                 {"finding", unbroken(escaped(report.finding))},
                 {"report", for_script(report_document(report))},
                 {"pictures", for_script(pictures)},
                 {"blobs", blobs.text()},
                 {"script", embedded_files(embedded_report(), ".js")}});
}

}  // namespace

std::string to_html(const Report& report, const HtmlOptions& options) {
  const int fits = std::min(options.largest_map, map_limit(report.objects.size(), report.scene.size()));
  Limits limits{fits, fits};
  int view_limit = options.largest_view;
  for (;;) {
    std::string page = page_with(report, limits, view_limit);
    if (page.size() <= options.most_bytes || limits.others <= smallest_map) return page;
    if (limits.others == limits.first) {
      limits.others /= 2;
    } else {
      limits.first = limits.others;
      view_limit /= 2;
    }
  }
}

}  // namespace rnmbake
