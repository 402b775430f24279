#include "pipeline/deliver/engines/raw_pages_target.h"

#include "pipeline/deliver/engines/web_decoder.h"
#include "pipeline/deliver/page_texels.h"

#include <spdlog/fmt/fmt.h>

namespace rnmbake {

const std::vector<std::string>& RawPagesTarget::encodings() const {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = web_encodings();
    all.emplace_back(flat);
    return all;
  }();
  return names;
}

nlohmann::ordered_json RawPagesTarget::write_page(DeliveryFiles& files, std::size_t number, Page page) const {
  nlohmann::ordered_json names = nlohmann::ordered_json::object();
  for (const Layer& layer : page.layers) {
    const std::string said = PageWriter::record_name(layer);
    const std::string file = fmt::format("page{}.{}.rgba16f", number, said);
    files.add(file, encode_texels(TexelFormat::rgba16_sfloat, layer.pixels).bytes);
    names[said] = file;
  }
  return names;
}

void RawPagesTarget::add_files(DeliveryFiles& files, nlohmann::ordered_json& record) const {
  record["decoder"] = web_decoder(record);
  for (const auto& [name, text] : web_files_) files.add(name, text);
}

}  // namespace rnmbake
