// base/progress.h - tells a person how far the work is: a bar on a terminal, else a line now and then.
#pragma once

#include "base/clock.h"

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace rnmbake {

struct ProgressOptions {
  enum class Style { off, lines, bar };
  Style style = Style::lines;
  double line_seconds = 10;  // between two lines
  double bar_seconds = 0.1;  // between two drawings of the bar
  int columns = 79;
  const Clock* clock = &steady_clock();
  /// Where the text goes; none: the log's information level, and for the bar log::draw_bar.
  std::function<void(std::string_view)> sink;
};

/// What fits this process: off when quiet, a bar if stderr is a terminal and the log is text, else lines.
ProgressOptions progress_for(bool quiet, bool jsonl);

/// Seconds as a person says them: "8 s", "3 min 20 s", "2 h 05 min".
std::string spoken_duration(double seconds);

/// Seconds of "90", "90s", "10m", "1.5h"; nothing where it is none of these, or not above 0.
std::optional<double> parse_duration(std::string_view text);

/// One piece of work from 0 to 1. May be updated from several threads. The remaining time is the rate between
/// the first advance and the last: what comes before the work (a scene that loads) is no part of it, and
/// while nothing advances the time runs down.
class Progress {
 public:
  Progress(std::string title, ProgressOptions options);
  ~Progress();  // takes the bar away
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `share` of the work is done (no number: unknown), `item` is in work. The share never goes back.
  void update(double share, std::string_view item);

  /// The remaining seconds; negative where nothing can be said.
  [[nodiscard]] double eta_seconds() const;

 private:
  void show_bar(std::string_view item);
  void show_line(std::string_view item);
  void advance(double share, double now);
  [[nodiscard]] std::string eta_text() const;

  struct Moment {
    double time, share;
  };

  std::string title_;
  ProgressOptions options_;
  double last_shown_;
  double share_ = 0;
  bool known_ = false;                  // a share was told
  std::optional<Moment> first_, last_;  // advances
  std::mutex mutex_;
};

}  // namespace rnmbake
