#include "pipeline/deliver/page_writer.h"

#include "base/error.h"
#include "base/files.h"
#include "image/ktx2.h"
#include "image/light_pictures.h"
#include "lightmap/fill.h"
#include "lightmap/mips.h"
#include "pipeline/deliver/page_texels.h"

#include <utility>

namespace rnmbake {
namespace {

bool has_negative(const FloatImage& image, const FloatImage& coverage) {
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (coverage.texel(x, y)[0] <= 0.5F) continue;
      for (const float value : image.texel(x, y))
        if (value < 0) return true;
    }
  }
  return false;
}

TexelFormat texel_format(PageFormat format, bool negative) {
  switch (format) {
    case PageFormat::ktx2_b10g11r11:
      return TexelFormat::b10g11r11_ufloat;
    case PageFormat::ktx2_e5b9g9r9:
      return TexelFormat::e5b9g9r9_ufloat;
    case PageFormat::ktx2_bc6h:
      return negative ? TexelFormat::bc6h_sfloat : TexelFormat::bc6h_ufloat;
    default:
      return TexelFormat::rgba16_sfloat;
  }
}

/// Blocks that hold a texel which is looked at have no empty ones beside it, which would bend their line.
/// `filled`: texels that have a value; `padding`: others that have one around these.
FloatImage with_whole_blocks(FloatImage image, const FloatImage& filled, TexelFormat format, int padding) {
  constexpr int others_of_block = 3;
  if (format == TexelFormat::bc6h_ufloat || format == TexelFormat::bc6h_sfloat)
    dilate(image, filled, padding + others_of_block);
  return image;
}

FloatImage seen_in(const std::filesystem::path& file) {
  return read_image(file).layers.front().pixels;
}

}  // namespace

nlohmann::ordered_json record_of(const PictureMetrics& lost) {
  return {{"relative_bias", lost.relative_bias.value},
          {"relative_rmse", lost.relative_rmse.value},
          {"max", lost.max}};
}

nlohmann::ordered_json PageWriter::write(std::size_t number, const Page& page) {
  nlohmann::ordered_json names = nlohmann::ordered_json::object();
  for (const Layer& layer : page.layers) {
    const std::string said = record_name(layer);
    if (!holds_negative(form_.format) && has_negative(layer.pixels, page.coverage))
      fail(ExitCode::unsupported,
           "page {}: layer '{}' has values below 0, which {} cannot hold; choose --page-format exr or "
           "ktx2-rgba16f",
           number, said, name_of(form_.format));
    const std::string file =
        fmt::format("page{}{}{}{}", number, before_layer_, said, ending_of(form_.format));
    const FloatImage seen = write_picture(file, layer.pixels, page);
    PictureComparison comparison;
    comparison.add({&seen}, {&layer.pixels}, {{&page.coverage}});
    losses_.push_back({number, said, comparison.metrics()});
    names[said] = file;
  }
  return names;
}

FloatImage PageWriter::write_picture(const std::string& name, const FloatImage& image, const Page& page) {
  const std::filesystem::path file = files_.add(name);
  if (form_.format == PageFormat::exr) {
    write_exr(file, {{{"", {"R", "G", "B"}, image}}, {}}, Depth::half);
    return seen_in(file);
  }
  if (form_.format == PageFormat::hdr) {
    write_hdr(file, image);
    return seen_in(file);
  }
  if (form_.format == PageFormat::png_rgbm) {
    write_rgbm(file, image);
    return read_rgbm(file);
  }
  return write_ktx2(file, image, page);
}

FloatImage PageWriter::write_ktx2(const std::filesystem::path& file, const FloatImage& image,
                                  const Page& page) const {
  const TexelFormat format = texel_format(form_.format, has_negative(image, page.coverage));
  EncodedTexels first = encode_texels(format, with_whole_blocks(image, page.filled, format, 0));
  Ktx2Texture texture{
      .format = format,
      .size = {static_cast<std::uint32_t>(image.width()), static_cast<std::uint32_t>(image.height()), 0},
      .levels = {std::move(first.bytes)},
      .zstd = form_.zstd};
  for (const MipLevel& level : mip_levels(image, page.seen, form_.mips, form_.padding))
    texture.levels.push_back(
        encode_texels(format, with_whole_blocks(level.image, level.coverage, format, form_.padding)).bytes);
  write_atomically(file, ktx2_of(texture));
  return std::move(first.seen);
}

}  // namespace rnmbake
