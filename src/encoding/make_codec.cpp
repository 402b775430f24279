#include "encoding/make_codec.h"

#include "base/error.h"
#include "encoding/lobe_codec.h"
#include "encoding/rnm_codec.h"

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

constexpr std::array<NamedMaker, 7> makers{{{"flat", make_flat},
                                            {"rnm", make_rnm},
                                            {"rnm-vrad", make_rnm},
                                            {"rnm-bakery", make_rnm},
                                            {"sh2", lobe_codec},
                                            {"zh3", lobe_codec},
                                            {"geomerics", lobe_codec}}};

}  // namespace

std::vector<std::string> codec_names() {
  std::vector<std::string> names;
  for (const NamedMaker& maker : makers) names.emplace_back(maker.name);
  return names;
}

std::unique_ptr<const Codec> make_codec(const CodecOptions& options, const BasisSet& directions) {
  const auto* found =
      std::ranges::find_if(makers, [&](const NamedMaker& maker) { return maker.name == options.name; });
  if (found == makers.end()) {
    fail(ExitCode::usage, "there is no encoding '{}'; choose one of {}", options.name,
         fmt::join(codec_names(), ", "));
  }
  return found->make(options, directions);
}

}  // namespace rnmbake
