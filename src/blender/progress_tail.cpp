#include "blender/progress_tail.h"

#include "base/json.h"
#include "base/read_file.h"

#include <string_view>

namespace rnmbake {

namespace {

constexpr std::size_t most_at_once = std::size_t{1} << 20, longest_line = std::size_t{64} << 10;

std::optional<ProgressEvent> event_in(std::string_view line) {
  const nlohmann::json json = json_or_null(line);
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
  const std::string added = read_part(file_, read_, most_at_once);
  read_ += added.size();
  rest_ += added;
  std::size_t begin = 0;
  for (std::size_t end = rest_.find('\n'); end != std::string::npos; end = rest_.find('\n', begin)) {
    const auto event = event_in(std::string_view(rest_).substr(begin, end - begin));
    begin = end + 1;
    if (event && on_event) on_event(*event);
  }
  rest_.erase(0, begin);
  if (rest_.size() > longest_line) rest_.clear();  // of a line so long, what is left will be no event
  return !added.empty();
}

}  // namespace rnmbake
