#include "pipeline/deliver/page_format.h"

#include "base/error.h"

#include <algorithm>
#include <array>

namespace rnmbake {
namespace {

struct Row {
  PageFormat format;
  const char *name, *ending;
  bool negative;
};

constexpr std::array rows{Row{PageFormat::exr, "exr", ".exr", true},
                          Row{PageFormat::hdr, "hdr", ".hdr", false},
                          Row{PageFormat::png_rgbm, "png-rgbm", ".rgbm.png", false},
                          Row{PageFormat::ktx2_rgba16f, "ktx2-rgba16f", ".ktx2", true},
                          Row{PageFormat::ktx2_b10g11r11, "ktx2-b10g11r11", ".ktx2", false},
                          Row{PageFormat::ktx2_e5b9g9r9, "ktx2-e5b9g9r9", ".ktx2", false},
                          Row{PageFormat::ktx2_bc6h, "ktx2-bc6h", ".ktx2", true}};

const Row& row_of(PageFormat format) {
  return *std::ranges::find(rows, format, &Row::format);
}

}  // namespace

const std::vector<PageFormat>& page_formats() {
  static const std::vector<PageFormat> all = [] {
    std::vector<PageFormat> formats;
    for (const Row& row : rows) formats.push_back(row.format);
    return formats;
  }();
  return all;
}

const char* name_of(PageFormat format) {
  return row_of(format).name;
}

PageFormat page_format(std::string_view name) {
  for (const Row& row : rows)
    if (name == row.name) return row.format;
  fail(ExitCode::usage, "'{}' is no format of pages", name);
}

const char* ending_of(PageFormat format) {
  return row_of(format).ending;
}

bool is_ktx2(PageFormat format) {
  return std::string_view(ending_of(format)) == ".ktx2";
}

bool holds_negative(PageFormat format) {
  return row_of(format).negative;
}

}  // namespace rnmbake
