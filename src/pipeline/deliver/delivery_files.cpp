#include "pipeline/deliver/delivery_files.h"

#include "base/files.h"
#include "base/json.h"
#include "base/read_file.h"

#include <algorithm>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

/// Names that the folder's record lists; none where there is no record that can be read.
std::vector<std::string> earlier_names(const fs::path& record) {
  if (!fs::is_regular_file(record)) return {};
  const nlohmann::json found = json_or_null(read_text(record));
  std::vector<std::string> names;
  if (!found.is_object() || !found.contains("files") || !found["files"].is_array()) return names;
  for (const nlohmann::json& name : found["files"])
    if (name.is_string()) names.push_back(name.get<std::string>());
  return names;
}

}  // namespace

fs::path DeliveryFiles::add(const std::string& name) {
  names_.push_back(name);
  return making_ / name;
}

void DeliveryFiles::add(const std::string& name, std::string_view text) {
  write_atomically(add(name), text);
}

std::size_t DeliveryFiles::put_in_place(nlohmann::ordered_json record) {
  const std::vector<std::string> earlier = earlier_names(folder_ / record_name);
  std::size_t written = 0;
  for (const std::string& name : names_) {
    const auto copy = [&](const fs::path& to) {
      fs::copy_file(making_ / name, to, fs::copy_options::overwrite_existing);
    };
    written += write_atomically(folder_ / name, copy) ? 1 : 0;
  }
  names_.emplace_back(record_name);
  record["files"] = names_;
  written += write_atomically(folder_ / record_name, record.dump(1) + "\n") ? 1 : 0;
  for (const std::string& name : earlier) {
    const auto left = file_inside(folder_, name);
    std::error_code gone;
    if (left && std::ranges::find(names_, name) == names_.end()) fs::remove(*left, gone);
  }
  return written;
}

}  // namespace rnmbake
