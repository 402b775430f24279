#include "pipeline/deliver/engines/bevy.h"

#include "pipeline/deliver/engines/shipped_files.h"

#include <spdlog/fmt/fmt.h>

namespace rnmbake {

namespace {

/// A string of Rust, which reads those of JSON.
std::string quoted(const nlohmann::ordered_json& name) {
  return name.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace

const std::vector<std::string>& Bevy::encodings() const {
  static const std::vector<std::string> flat_alone{flat};
  return flat_alone;
}

const std::vector<PageFormat>& Bevy::formats() const {
  static const std::vector<PageFormat> all{PageFormat::ktx2_rgba16f, PageFormat::ktx2_b10g11r11,
                                           PageFormat::ktx2_e5b9g9r9, PageFormat::ktx2_bc6h, PageFormat::exr};
  return all;
}

void Bevy::add_files(DeliveryFiles& files, nlohmann::ordered_json& record) const {
  std::string pages, nodes;
  for (const auto& page : record.at("pages"))
    pages += fmt::format("    {},\n", quoted(page.at("layers").at(flat)));
  for (const auto& object : record.at("objects"))
    nodes += fmt::format("    ({}, {}),\n", quoted(object.at("name")), object.at("page").get<int>());
  const std::string tables = fmt::format(
      "const PAGES: [&str; {}] = [\n{}];\n\n// Name of a node, and its page.\nconst LIGHTMAPPED: [(&str, "
      "usize); {}] = [\n{}];\n",
      record.at("pages").size(), pages, record.at("objects").size(), nodes);
  for (const auto& [name, text] : embedded_bevy_files()) files.add(name, text + tables);
}

}  // namespace rnmbake
