// Feeds broken files of a launch to their readers: result.json, progress.jsonl, and survey.json with its
// data. Every one is taken or refused with an Error. Run by ./dev fuzz launch.
//
// An input is a letter that says which file it is, and the file; for a survey the data follows a zero byte.
#include "base/error.h"
#include "base/files.h"
#include "base/json.h"
#include "base/log.h"
#include "blender/launch_watch.h"
#include "blender/outcome.h"
#include "blender/progress_tail.h"
#include "pipeline/scene/launch_answer.h"
#include "scene/diffuse_scene.h"
#include "scene/survey_parse.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

using namespace rnmbake;

const std::filesystem::path& folder() {
  static const TempFolder made("/dev/shm");
  return made.path();
}

void read_result(const std::string& text) {
  Launch launch;
  launch.folder = folder();
  write_atomically(folder() / "result.json", text);
  const LaunchOutcome outcome = judge(launch, {}, {}, "n", {}, LaunchWatch(folder(), {}));
  if (const auto* failure = std::get_if<LaunchFailure>(&outcome)) {
    if (failure->kind == LaunchFailure::Kind::refused && failure->code == 0) std::abort();
    return;
  }
  const nlohmann::json& result = std::get<Finished>(outcome).result;
  for (const char* key : {"survey", "blend", "file"}) {
    try {
      const auto file = answered_file(result, key, folder());
      if (file.parent_path() != folder()) std::abort();
    } catch (const Error&) {
    }
  }
}

void read_progress(const std::string& text) {
  write_atomically(folder() / "progress.jsonl", text);
  ProgressTail tail(folder() / "progress.jsonl");
  while (tail.poll([](const ProgressEvent& event) { log::debug("{}", event.what); })) {
  }
}

/// The JSON with the size that the data has, or nearly no input would get past that check.
std::string with_size(const std::string& text, std::size_t bytes) {
  nlohmann::json content = json_or_null(text);
  if (!content.is_object()) return text;
  content["data"] = "survey.bin";
  content["data_bytes"] = bytes;
  return content.dump();
}

void read_scene(const std::string& bytes, bool exported) {
  const std::size_t end = std::min(bytes.find('\0'), bytes.size());
  const std::string data = bytes.substr(std::min(end + 1, bytes.size()));
  write_atomically(folder() / "survey.json", with_size(bytes.substr(0, end), data.size()));
  write_atomically(folder() / "survey.bin", data);
  if (exported) {
    (void)read_exported(folder() / "survey.json");
  } else {
    (void)read_survey(folder() / "survey.json");
  }
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  log::init(-1, log::Format::text);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string file(data + 1, data + size);
  try {
    if (data[0] == 'r') read_result(file);
    if (data[0] == 'p') read_progress(file);
    if (data[0] == 's' || data[0] == 'e') read_scene(file, data[0] == 'e');
  } catch (const Error&) {
  }
  return 0;
}
