// pipeline/deliver/page_writer.h - layers of pages as files of a format, and what that loses.
#pragma once

#include "image/metrics.h"
#include "pipeline/deliver/delivery_files.h"
#include "pipeline/deliver/page_format.h"
#include "pipeline/deliver/pages.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

/// Of one layer, against its values before: over the covered texels, in E/pi.
struct PageLoss {
  std::size_t page = 0;
  std::string layer;  // as the record has it
  PictureMetrics lost;
};

/// "relative_bias", "relative_rmse" and "max", as every record has what a picture loses.
[[nodiscard]] nlohmann::ordered_json record_of(const PictureMetrics& lost);

class PageWriter {
 public:
  static constexpr const char* flat = "flat";  // the record's name for the encoding without directions

  /// `before_layer` is between "pageN" and the layer in the names of files.
  PageWriter(DeliveryFiles& files, PageForm form, char before_layer = '.')
      : files_(files), form_(form), before_layer_(before_layer) {}

  [[nodiscard]] static std::string record_name(const Layer& layer) {
    return layer.name.empty() ? flat : layer.name;
  }

  [[nodiscard]] const PageForm& form() const { return form_; }

  /// Writes all layers as pageN.LAYER with the format's ending, or with what else is before the layer;
  /// returns the file of each, by its name. Throws Error(unsupported) naming a layer whose values the format
  /// cannot hold.
  [[nodiscard]] nlohmann::ordered_json write(std::size_t number, const Page& page);

  /// Of all layers so far.
  [[nodiscard]] const std::vector<PageLoss>& losses() const { return losses_; }

 private:
  /// Writes the file; returns what is seen of it.
  [[nodiscard]] FloatImage write_picture(const std::string& file, const FloatImage& image, const Page& page);
  [[nodiscard]] FloatImage write_ktx2(const std::filesystem::path& file, const FloatImage& image,
                                      const Page& page) const;

  DeliveryFiles& files_;
  PageForm form_;
  char before_layer_;
  std::vector<PageLoss> losses_;
};

}  // namespace rnmbake
