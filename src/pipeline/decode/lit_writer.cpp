#include "pipeline/decode/lit_writer.h"

#include "base/text.h"
#include "image/display_png.h"

#include <cmath>

namespace rnmbake {
namespace {

PictureForm form_of(int width, int height, bool is_display, const std::string& variant, float exposure) {
  PictureForm form{width, height, {"R", "G", "B"}, is_display ? Storage::u8 : Storage::full, {}};
  if (is_display) {
    form.attributes["oiio:ColorSpace"] = "sRGB";
  } else {
    form.attributes["rnmbake:decoded"] = variant;
    form.attributes["rnmbake:exposure"] = exposure;
  }
  return form;
}

}  // namespace

LitWriter::LitWriter(const std::filesystem::path& file, int width, int height, const std::string& variant,
                     float exposure)
    : is_display_(lower_extension(file) == ".png"),
      gain_(std::exp2(exposure)),
      writer_(file, form_of(width, height, is_display_, variant, exposure)) {}

void LitWriter::write(int begin, int end, FloatImage&& lit) {
  for (float& value : lit.data()) value = is_display_ ? srgb_encode(gain_ * value) : gain_ * value;
  writer_.write(begin, end, lit.data());
}

}  // namespace rnmbake
