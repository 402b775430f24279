// encoding/codecs/make_codec.h - the codecs by the names that users type.
#pragma once

#include "encoding/codec.h"

#include <memory>
#include <string>
#include <vector>

namespace rnmbake {

/// Every name that make_codec() knows.
[[nodiscard]] std::vector<std::string> codec_names();

/// sh2, zh3, geomerics: a and v for each colour, which can be packed and, plain and made from four bakes,
/// return these.
[[nodiscard]] bool holds_four_numbers(const std::string& encoding);

/// `sh2` is fitted to all directions where there are more than flat and rnm; packed it uses those four.
/// Throws Error(usage) for a name that does not exist, Error(unsupported), with the remedy, where
/// `directions` cannot feed the encoding.
[[nodiscard]] std::unique_ptr<const Codec> make_codec(const CodecOptions& options,
                                                      const BasisSet& directions);

}  // namespace rnmbake
