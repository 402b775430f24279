#include "blender/launch_watch.h"

#include <algorithm>
#include <utility>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {

std::string in_words(const ProgressEvent& event) {
  std::string text = event.phase.empty() ? "start-up" : event.phase;
  if (!event.what.empty()) text += " " + event.what;
  if (!event.detail.empty()) text += ", " + event.detail;
  return text;
}

LaunchWatch::LaunchWatch(const std::filesystem::path& folder,
                         std::function<void(const ProgressEvent&)> on_progress)
    : events_(folder / "progress.jsonl"), log_(folder / "stdout.log"), on_progress_(std::move(on_progress)) {}

bool LaunchWatch::poll() {
  bool progressed = false;
  events_.poll([&](const ProgressEvent& event) {
    ++heard_;
    progressed |= is_new(event);
    begun_ = last_ = event;
    if (on_progress_) on_progress_(event);
  });
  progressed |= log_.poll();
  if (log_.event() == heard_) go_on_with_last();
  if (on_progress_) on_progress_(last_);
  // A Cycles that cannot speak at all is given the benefit of the doubt while it bakes.
  return progressed || (begun_.samples > 0 && !log_.hears_cycles());
}

/// Whether an event differs from the last: a script that repeats one makes no progress.
bool LaunchWatch::is_new(const ProgressEvent& event) {
  return event.phase != begun_.phase || event.what != begun_.what || event.done != begun_.done;
}

void LaunchWatch::go_on_with_last() {
  last_ = begun_;
  last_.detail = log_.doing();
  if (begun_.samples > 0 && log_.samples() > 0) {
    const double share = std::min(1.0, log_.samples() / begun_.samples);
    last_.done += std::max(0.0, begun_.until - begun_.done) * share;
    last_.detail =
        fmt::format("{:.0f} of {:.0f} samples", std::min(log_.samples(), begun_.samples), begun_.samples);
  }
}

}  // namespace rnmbake
