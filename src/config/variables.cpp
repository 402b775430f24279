#include "config/variables.h"

#include "base/error.h"
#include "base/names.h"
#include "config/settings.h"

#include <algorithm>
#include <iterator>
#include <string_view>

#include <unistd.h>

namespace rnmbake {

namespace {

/// Of the tests, and the mark of what a launch started (process/tree.h), which may be a rnmbake.
constexpr const char* of_no_setting[] = {"RNMBAKE_BINARY", "RNMBAKE_CHROMIUM", "RNMBAKE_SCREENSHOTS",
                                         "RNMBAKE_LAUNCHED_BY"};

}  // namespace

std::vector<std::string> variables_set() {
  std::vector<std::string> names;
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string_view text = *entry;
    const std::size_t end = text.find('=');
    if (end + 1 < text.size()) names.emplace_back(text.substr(0, end));
  }
  return names;
}

void refuse_unknown_variables(const std::vector<std::string>& names) {
  std::vector<std::string> known(std::begin(of_no_setting), std::end(of_no_setting));
  for (const Setting& setting : settings()) known.push_back(setting.environment());
  for (const std::string& name : names) {
    if (!name.starts_with("RNMBAKE_") || std::ranges::find(known, name) != known.end()) continue;
    const std::string hint = did_you_mean(name, known);
    fail(ExitCode::usage, "{}: no setting has this variable{}", name,
         hint.empty() ? "; unset it (docs/project-file.md lists the settings)" : hint);
  }
}

}  // namespace rnmbake
