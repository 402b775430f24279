#include "base/progress.h"

#include "base/log.h"
#include "base/names.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {

ProgressOptions progress_for(bool quiet, bool jsonl) {
  ProgressOptions options;
  if (quiet) {
    options.style = ProgressOptions::Style::off;
  } else if (log::stderr_is_terminal() && !jsonl) {
    options.style = ProgressOptions::Style::bar;
  }
  return options;
}

std::string spoken_duration(double seconds) {
  const auto whole = static_cast<long>(std::lround(std::max(0.0, seconds)));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

Progress::Progress(std::string title, ProgressOptions options)
    : title_(std::move(title)),
      options_(std::move(options)),
      started_(options_.clock->now()),
      // The first line comes after a whole interval (short work says nothing), the first bar at once.
      last_shown_(options_.style == ProgressOptions::Style::bar ? started_ - options_.bar_seconds
                                                                : started_) {}

Progress::~Progress() {
  if (options_.style != ProgressOptions::Style::bar) return;
  if (options_.sink) {
    options_.sink("");
  } else {
    log::draw_bar("");
  }
}

void Progress::update(double share, std::string_view item) {
  if (options_.style == ProgressOptions::Style::off) return;
  const std::lock_guard lock(mutex_);
  if (std::isfinite(share)) share_ = std::clamp(share, share_, 1.0);
  const bool bar = options_.style == ProgressOptions::Style::bar;
  const double now = options_.clock->now();
  if (now - last_shown_ < (bar ? options_.bar_seconds : options_.line_seconds)) return;
  last_shown_ = now;
  if (bar) {
    show_bar(item);
  } else {
    show_line(item);
  }
}

double Progress::eta_seconds() const {
  const double elapsed = options_.clock->now() - started_;
  if (share_ < 0.01 || elapsed < 1) return -1;
  return elapsed * (1 - share_) / share_;
}

std::string Progress::eta_text() const {
  const double eta = eta_seconds();
  return eta < 0 ? "" : fmt::format(", {} left", spoken_duration(eta));
}

void Progress::show_bar(std::string_view item) {
  constexpr int cells = 24;
  const int full = static_cast<int>(share_ * cells);
  std::string text = fmt::format("{} [{}{}] {:3.0f} %{} {}", title_, std::string(full, '#'),
                                 std::string(cells - full, '.'), std::floor(share_ * 100), eta_text(), item);
  text = cut_utf8(text, static_cast<std::size_t>(options_.columns));
  if (options_.sink) {
    options_.sink(text);
  } else {
    log::draw_bar(text);
  }
}

void Progress::show_line(std::string_view item) {
  const std::string text = fmt::format("{}: {:.0f} %{}{}{}", title_, std::floor(share_ * 100), eta_text(),
                                       item.empty() ? "" : ", at ", item);
  if (options_.sink) {
    options_.sink(text);
  } else {
    log::info("{}", text);
  }
}

}  // namespace rnmbake
