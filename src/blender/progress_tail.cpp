#include "blender/progress_tail.h"

#include <fstream>
#include <iterator>

namespace rnmbake {

namespace {

std::optional<ProgressEvent> event_in(const std::string& line) {
  const nlohmann::json json = nlohmann::json::parse(line, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  try {
    ProgressEvent event;
    event.phase = json.value("phase", "");
    event.what = json.value("what", "");
    event.done = json.value("done", 0.0);
    event.total = json.value("total", 0.0);
    event.until = json.value("until", 0.0);
    event.samples = json.value("samples", 0.0);
    return event;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

}  // namespace

bool ProgressTail::poll(const std::function<void(const ProgressEvent&)>& on_event) {
  std::ifstream stream(file_, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(read_));
  if (!stream) return false;
  const std::string added{std::istreambuf_iterator<char>(stream), {}};
  read_ += added.size();
  rest_ += added;
  for (std::size_t end = rest_.find('\n'); end != std::string::npos; end = rest_.find('\n')) {
    const auto event = event_in(rest_.substr(0, end));
    rest_.erase(0, end + 1);
    if (event && on_event) on_event(*event);
  }
  return !added.empty();
}

}  // namespace rnmbake
