#include "base/progress.h"

#include "base/events/log_event.h"
#include "base/log.h"
#include "base/text.h"
#include "base/utf8.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace rnmbake {

namespace {

// From less than that the rate says little.
constexpr double least_seconds = 2, least_share = 0.02;

// Between two events for a program, which draws its own bar from them.
constexpr double jsonl_seconds = 1;

}  // namespace

ProgressOptions progress_for(bool quiet, bool jsonl) {
  ProgressOptions options;
  if (quiet) {
    options.style = ProgressOptions::Style::off;
  } else if (log::stderr_is_terminal() && !jsonl) {
    options.style = ProgressOptions::Style::bar;
  }
  if (jsonl) options.line_seconds = jsonl_seconds;
  return options;
}

std::optional<double> parse_duration(std::string_view text) {
  double value = 0;
  const auto [rest, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc{} || !(value > 0) || !std::isfinite(value)) return std::nullopt;
  const std::string_view unit(rest, std::size_t(text.data() + text.size() - rest));
  if (unit.empty() || unit == "s") return value;
  if (unit == "m") return value * 60;
  if (unit == "h") return value * 3600;
  return std::nullopt;
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
      // The first line comes after a whole interval (short work says nothing), the first bar at once.
      last_shown_(options_.clock->now() -
                  (options_.style == ProgressOptions::Style::bar ? options_.bar_seconds : 0)) {}

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
  const bool bar = options_.style == ProgressOptions::Style::bar;
  const double now = options_.clock->now();
  if (std::isfinite(share)) advance(std::min(share, 1.0), now);
  if (now - last_shown_ < (bar ? options_.bar_seconds : options_.line_seconds)) return;
  last_shown_ = now;
  if (bar) {
    show_bar(item);
  } else {
    show_line(item);
  }
}

void Progress::advance(double share, double now) {
  known_ = true;
  if (share <= share_) return;
  share_ = share;
  last_ = {now, share};
  if (!first_) first_ = last_;
}

double Progress::eta_seconds() const {
  if (!first_) return -1;
  const double seconds = last_->time - first_->time, done = last_->share - first_->share;
  if (seconds < least_seconds || done < least_share) return -1;
  return seconds / done * (1 - share_) - (options_.clock->now() - last_->time);
}

std::string Progress::eta_text() const {
  const double eta = eta_seconds();
  return eta < 0 ? "" : fmt::format(", {} left", spoken_duration(eta));
}

void Progress::show_bar(std::string_view item) {
  constexpr int cells = 24;
  const int full = static_cast<int>(share_ * cells);
  const std::string percent = known_ ? fmt::format(" {:3.0f} %", std::floor(share_ * 100)) : "";
  std::string text = fmt::format("{} [{}{}]{}{} {}", title_, std::string(full, '#'),
                                 std::string(cells - full, '.'), percent, eta_text(), item);
  text = cut_utf8(printable(text), static_cast<std::size_t>(options_.columns));
  if (options_.sink) {
    options_.sink(text);
  } else {
    log::draw_bar(text);
  }
}

void Progress::show_line(std::string_view item) {
  const std::string share = known_ ? fmt::format("{:.0f} %{}, ", std::floor(share_ * 100), eta_text()) : "";
  const std::string text = fmt::format("{}: {}at {}", title_, share, item.empty() ? "work" : item);
  if (options_.sink) {
    options_.sink(text);
  } else {
    const double unknown = std::numeric_limits<double>::quiet_NaN(), eta = eta_seconds();
    log::event(log::Level::info, "progress", text,
               {{"title", title_},
                {"share", known_ ? share_ : unknown},
                {"seconds_left", eta < 0 ? unknown : eta},
                {"item", std::string(item)}});
  }
}

}  // namespace rnmbake
