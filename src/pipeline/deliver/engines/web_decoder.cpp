#include "pipeline/deliver/engines/web_decoder.h"

#include "shaders/engines.h"

#include <algorithm>
#include <array>
#include <utility>

namespace rnmbake {

namespace {

struct WebDecoder {
  const char *encoding, *shader, *function;
};

constexpr std::array<WebDecoder, 9> decoders{{{"rnm-vrad", "rnm", "rnm_decode_squared"},
                                              {"rnm", "rnm", "rnm_decode_squared"},
                                              {"rnm-signed", "rnm", "rnm_decode_linear"},
                                              {"rnm-bakery", "rnm", "rnm_decode_linear"},
                                              {"zh3", "zh3", "zh3_decode"},
                                              {"sh2", "sh2", "sh2_decode"},
                                              {"geomerics", "geomerics", "geomerics_decode"},
                                              {"h4", "hbasis", "h4_decode"},
                                              {"h6", "hbasis", "h6_decode"}}};

}  // namespace

const std::vector<std::string>& web_encodings() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const WebDecoder& decoder : decoders) all.emplace_back(decoder.encoding);
    return all;
  }();
  return names;
}

nlohmann::json web_decoder(const nlohmann::ordered_json& record) {
  const auto* const found =
      std::ranges::find(decoders, record.at("encoding").get<std::string>(), &WebDecoder::encoding);
  nlohmann::json layers = nlohmann::json::array();
  for (const auto& [layer, file] : record.at("pages").at(0).at("layers").items()) layers.push_back(layer);
  return {{"layers", std::move(layers)},
          {"function", found->function},
          {"text", shader_text(engine_named("glsl"), {found->shader})}};
}

}  // namespace rnmbake
