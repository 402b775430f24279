#include "pipeline/deliver/engines/raw_pages_target.h"

#include "pipeline/deliver/engines/raw_page.h"
#include "pipeline/deliver/engines/web_decoder.h"

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
  return write_raw_page(files, number, page);
}

void RawPagesTarget::add_files(DeliveryFiles& files, nlohmann::ordered_json& record) const {
  record["decoder"] = web_decoder(record);
  for (const auto& [name, text] : web_files()) files.add(name, text);
}

}  // namespace rnmbake
