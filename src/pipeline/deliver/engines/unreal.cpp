#include "pipeline/deliver/engines/unreal.h"

#include "pipeline/deliver/engines/shipped_files.h"
#include "pipeline/deliver/engines/unreal_names.h"
#include "pipeline/deliver/engines/web_decoder.h"

namespace rnmbake {

const std::vector<std::string>& Unreal::encodings() const {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = web_encodings();
    all.emplace_back(flat);
    return all;
  }();
  return names;
}

nlohmann::ordered_json Unreal::write_page(DeliveryFiles& files, std::size_t number, Page page) const {
  return PageWriter(files, {.format = PageFormat::exr}, '_').write(number, page);
}

void Unreal::add_files(DeliveryFiles& files, nlohmann::ordered_json& record) const {
  const GlbNodes nodes(files.made("scene.glb"));
  const UnrealNames names(nodes);
  for (const auto& object : record.at("objects")) names.check(object.at("node").get<std::size_t>());
  if (record.at("encoding") != flat) record["decoder"] = web_decoder(record, "unreal");
  for (const auto& [name, text] : embedded_unreal_files()) files.add(name, text);
}

}  // namespace rnmbake
