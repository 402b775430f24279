#include "pipeline/scene/launch_answer.h"

#include "base/error.h"
#include "base/json.h"
#include "base/read_file.h"

namespace rnmbake {

namespace fs = std::filesystem;

fs::path answered_file(const nlohmann::json& name, const fs::path& folder) {
  const auto* text = name.get_ptr<const std::string*>();
  const auto file = text == nullptr ? std::nullopt : file_inside(folder, *text);
  std::error_code error;
  if (!file || !fs::is_regular_file(*file, error)) {
    fail(ExitCode::tasks_failed, "a script of rnmbake promised the file {}, which is not in {}", brief(name),
         folder.string());
  }
  return *file;
}

fs::path answered_file(const nlohmann::json& answer, const char* key, const fs::path& folder) {
  const auto found = answer.find(key);
  return answered_file(found == answer.end() ? nlohmann::json(key) : *found, folder);
}

}  // namespace rnmbake
