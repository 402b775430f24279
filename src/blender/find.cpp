#include "blender/find.h"

#include "base/error.h"
#include "base/names.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

#include <unistd.h>

namespace rnmbake {

namespace fs = std::filesystem;

namespace {

bool can_run(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error) && ::access(file.c_str(), X_OK) == 0;
}

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

std::optional<fs::path> in_path(const std::string& program) {
  std::string rest = variable("PATH");
  while (!rest.empty()) {
    const std::size_t colon = rest.find(':');
    const fs::path candidate = fs::path(rest.substr(0, colon)) / program;
    if (can_run(candidate)) return candidate;
    rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
  }
  return std::nullopt;
}

/// `folder`/blender*/blender, the last by name (most likely the newest) first.
std::vector<fs::path> unpacked_releases(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (glob_match("[bB]lender*", it->path().filename().string())) found.push_back(it->path() / "blender");
  }
  std::sort(found.rbegin(), found.rend());
  return found;
}

std::vector<fs::path> usual_places() {
  std::vector<fs::path> places = {"/usr/bin/blender", "/usr/local/bin/blender"};
  const auto append = [&](const std::vector<fs::path>& more) {
    places.insert(places.end(), more.begin(), more.end());
  };
  append(unpacked_releases("/opt"));
  places.emplace_back("/snap/bin/blender");
  if (const std::string home = variable("HOME"); !home.empty()) append(unpacked_releases(home));
  places.emplace_back("/Applications/Blender.app/Contents/MacOS/Blender");
  return places;
}

fs::path named(const std::string& wanted, const char* by) {
  if (wanted.find('/') == std::string::npos) {
    if (const auto found = in_path(wanted)) return *found;
  }
  fs::path path = fs::absolute(wanted);
  if (fs::is_directory(path) && can_run(path / "blender")) return path / "blender";
  if (!fs::exists(path))
    fail(ExitCode::environment, "{}: there is no {}; give the path of a Blender", by, wanted);
  if (!can_run(path))
    fail(ExitCode::environment, "{}: {} is not a program; give the path of a Blender", by, wanted);
  return path;
}

}  // namespace

fs::path find_blender(const std::optional<std::string>& wanted) {
  if (wanted && !wanted->empty()) return named(*wanted, "--blender");
  if (const std::string text = variable("RNMBAKE_BLENDER"); !text.empty())
    return named(text, "RNMBAKE_BLENDER");
  if (const auto found = in_path("blender")) return *found;
  const std::vector<fs::path> places = usual_places();
  const auto found = std::find_if(places.begin(), places.end(), can_run);
  if (found != places.end()) return *found;
  fail(ExitCode::environment,
       "no Blender found in PATH, /opt, /snap or the home folder; install one (Debian: apt install blender) "
       "or "
       "name it with --blender or RNMBAKE_BLENDER");
}

}  // namespace rnmbake
