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

bool put(const fs::path& file, std::string_view bytes) {
  if (fs::is_regular_file(file) && fs::file_size(file) == bytes.size() && read_text(file) == bytes)
    return false;
  write_atomically(file, bytes);
  return true;
}

}  // namespace

fs::path DeliveryFiles::add(const std::string& name) {
  names_.push_back(name);
  return making_ / name;
}

void DeliveryFiles::add(const std::string& name, std::string_view text) {
  write_atomically(add(name), text);
}

std::size_t DeliveryFiles::put_into(const fs::path& folder, nlohmann::ordered_json record) {
  const std::vector<std::string> earlier = earlier_names(folder / record_name);
  std::size_t written = 0;
  for (const std::string& name : names_) written += put(folder / name, read_text(making_ / name)) ? 1 : 0;
  names_.emplace_back(record_name);
  record["files"] = names_;
  written += put(folder / record_name, record.dump(1) + "\n") ? 1 : 0;
  for (const std::string& name : earlier) {
    const auto left = file_inside(folder, name);
    std::error_code gone;
    if (left && std::ranges::find(names_, name) == names_.end()) fs::remove(*left, gone);
  }
  return written;
}

}  // namespace rnmbake
