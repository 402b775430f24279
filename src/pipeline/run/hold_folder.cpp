#include "pipeline/run/hold_folder.h"

#include "base/error.h"
#include "base/files.h"
#include "blender/blender_session.h"
#include "process/stop.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

namespace rnmbake {

namespace {

/// As it was typed, without quotes; "" where the system does not tell.
std::string own_command_line() {
  std::ifstream stream("/proc/self/cmdline", std::ios::binary);
  std::string words{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  while (!words.empty() && words.back() == '\0') words.pop_back();
  std::replace(words.begin(), words.end(), '\0', ' ');
  return words;
}

}  // namespace

FolderLock hold_folder(const std::filesystem::path& folder, int wait_seconds) {
  make_folders(folder);
  try {
    return {folder, {own_command_line(), double(wait_seconds), [] { return StopRequest::requested(); }}};
  } catch (const Error&) {
    if (StopRequest::requested()) throw Interrupted{StopRequest::signal()};
    throw;
  }
}

}  // namespace rnmbake
