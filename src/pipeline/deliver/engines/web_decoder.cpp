#include "pipeline/deliver/engines/web_decoder.h"

#include "pipeline/deliver/engine_target.h"
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

constexpr const char* flat_light = "vec3 flat_light(vec3 light, vec3 n)\n{\n    return light;\n}\n";

}  // namespace

const std::vector<std::string>& web_encodings() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const WebDecoder& decoder : decoders) all.emplace_back(decoder.encoding);
    return all;
  }();
  return names;
}

nlohmann::json web_decoder(const nlohmann::ordered_json& record, const std::string& shader_engine) {
  const std::string encoding = record.at("encoding").get<std::string>();
  nlohmann::json layers = nlohmann::json::array();
  for (const auto& [layer, file] : record.at("pages").at(0).at("layers").items()) layers.push_back(layer);
  if (encoding == EngineTarget::flat)
    return {{"layers", std::move(layers)}, {"function", "flat_light"}, {"text", flat_light}};
  const auto* const found = std::ranges::find(decoders, encoding, &WebDecoder::encoding);
  return {{"layers", std::move(layers)},
          {"function", found->function},
          {"text", shader_text(engine_named(shader_engine), {found->shader})}};
}

}  // namespace rnmbake
