#include "encoding/codecs/make_codec.h"

#include "base/error.h"
#include "encoding/codecs/direction_codecs.h"
#include "encoding/codecs/linear_codec.h"
#include "encoding/codecs/lobe_codec.h"
#include "encoding/codecs/packed_codec.h"
#include "encoding/codecs/rnm_codec.h"

#include <algorithm>
#include <array>

namespace rnmbake {
namespace {

using Maker = std::unique_ptr<const Codec> (*)(const CodecOptions&, const BasisSet&);

struct NamedMaker {
  const char* name;
  Maker make;
};

std::unique_ptr<const Codec> make_flat(const CodecOptions&, const BasisSet& directions) {
  return flat_codec(directions);
}

std::unique_ptr<const Codec> make_rnm(const CodecOptions& options, const BasisSet& directions) {
  return rnm_codec(options.name, directions);
}

std::unique_ptr<const Codec> make_lobe(const CodecOptions& options, const BasisSet& directions) {
  if (options.range > 0) return packed_codec(options, directions);
  const bool has_more = directions.directions.size() > 4 || !holds_rnm(directions);
  return options.name == "sh2" && has_more ? linear_codec(options, directions)
                                           : lobe_codec(options, directions);
}

constexpr std::array<NamedMaker, 14> makers{{{"flat", make_flat},
                                             {"rnm", make_rnm},
                                             {"rnm-vrad", make_rnm},
                                             {"rnm-signed", signed_codec},
                                             {"rnm-bakery", make_rnm},
                                             {"sh2", make_lobe},
                                             {"zh3", make_lobe},
                                             {"geomerics", make_lobe},
                                             {"ahd", ahd_codec},
                                             {"dominant", dominant_codec},
                                             {"sh3", linear_codec},
                                             {"h4", linear_codec},
                                             {"h6", linear_codec},
                                             {"sg", linear_codec}}};

void check_packing(const CodecOptions& options) {
  const bool is_packed = options.range != 0;
  if (!holds_four_numbers(options.name) && (is_packed || options.bits != 0 || options.mono)) {
    fail(ExitCode::usage, "the encoding '{}' has no range, bits or mono; sh2, zh3 and geomerics have them",
         options.name);
  }
  if (is_packed && !(options.range > 0 && options.range <= 1024))
    fail(ExitCode::usage, "the range {} of '{}' is none; give 2, 4, or 0 for none", options.range,
         options.name);
  if (!is_packed && (options.bits != 0 || options.mono))
    fail(ExitCode::usage, "'{}' without a range cannot be packed; give the range 2 or 4", options.name);
  if (options.bits != 0 && options.bits != 8 && options.bits != 16)
    fail(ExitCode::usage, "'{}' cannot be packed in {} bits; give 8, 16, or 0 for floats", options.name,
         options.bits);
}

}  // namespace

std::vector<std::string> codec_names() {
  std::vector<std::string> names;
  names.reserve(makers.size());
  for (const NamedMaker& maker : makers) names.emplace_back(maker.name);
  return names;
}

bool holds_four_numbers(const std::string& encoding) {
  const auto* found =
      std::ranges::find_if(makers, [&](const NamedMaker& maker) { return maker.name == encoding; });
  return found != makers.end() && found->make == make_lobe;
}

std::unique_ptr<const Codec> make_codec(const CodecOptions& options, const BasisSet& directions) {
  const auto* found =
      std::ranges::find_if(makers, [&](const NamedMaker& maker) { return maker.name == options.name; });
  if (found == makers.end()) {
    fail(ExitCode::usage, "there is no encoding '{}'; choose one of {}", options.name,
         fmt::join(codec_names(), ", "));
  }
  check_packing(options);
  return found->make(options, directions);
}

}  // namespace rnmbake
