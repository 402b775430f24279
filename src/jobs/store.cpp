#include "jobs/store.h"

#include "base/files.h"
#include "base/read_file.h"

#include <utility>

namespace rnmbake {

namespace fs = std::filesystem;

Store::Store(fs::path folder, std::int64_t limit) : folder_(std::move(folder)), limit_(limit) {}

fs::path Store::file_of(const ResultKey& key) const {
  return folder_ / key.kind / key.digits.substr(0, 2) / key.digits;
}

std::optional<std::string> Store::get(const ResultKey& key) {
  if (!has(key)) return std::nullopt;
  return read_text(file_of(key));
}

bool Store::has(const ResultKey& key) const {
  std::error_code error;
  return !folder_.empty() && fs::exists(file_of(key), error);
}

void Store::put(const ResultKey& key, std::string_view bytes) {
  if (folder_.empty() || has(key)) return;
  make_folders(file_of(key).parent_path());
  write_atomically(file_of(key), bytes);
}

void Store::remove(const ResultKey& key) {
  std::error_code error;
  if (!folder_.empty()) fs::remove(file_of(key), error);
}

}  // namespace rnmbake
