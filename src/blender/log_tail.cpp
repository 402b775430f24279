#include "blender/log_tail.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <optional>

namespace rnmbake {

namespace {

constexpr std::size_t chunk_bytes = 1 << 20;
constexpr int most_chunks = 64;  // of one poll
constexpr std::size_t longest_line = 1 << 16;
constexpr std::size_t most_lines = 100'000;  // to remember; with more than that nothing is new any more

constexpr std::string_view event_sign = "rnmbake: event ";

std::optional<double> number_after(std::string_view line, std::string_view words) {
  const std::size_t at = line.find(words);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string digits(line.substr(at + words.size(), 20));
  char* end = nullptr;
  const double number = std::strtod(digits.c_str(), &end);
  return end == digits.c_str() ? std::nullopt : std::optional(number);
}

/// Cycles' debug output: "Rendered 64 samples in 1.2 seconds (0.02 seconds per sample), ...". The summary of
/// a whole picture begins alike.
std::optional<double> samples_in(std::string_view line) {
  if (line.find(" seconds per sample)") == std::string_view::npos) return std::nullopt;
  return number_after(line, "Rendered ");
}

/// Status in a line about the frame in work, without memory and times: "Updating Images | Loading wall.png",
/// in 3.x and 4.x after the scene's name.
std::string status_in(std::string_view line) {
  std::string status;
  while (!line.empty()) {
    const std::size_t bar = std::min(line.find(" | "), line.size());
    const std::string_view field = line.substr(0, bar);
    line.remove_prefix(std::min(bar + 3, line.size()));
    const bool changes = field.starts_with("Fra:") || field.starts_with("Time:") ||
                         field.starts_with("Mem:") || field.starts_with("Remaining:");
    if (!changes) status.append(status.empty() ? "" : " | ").append(field);
  }
  return status;
}

/// "I1128 16:48:38.035966 12369 svm.cpp:149] ...", from 5.0 on "00:10.376  cycles           | ...".
bool is_of_cycles(std::string_view line) {
  return line.find(".cpp:") != std::string_view::npos || line.find(" cycles ") != std::string_view::npos;
}

/// The C library's words, and Cycles' when it moves the tiles of a large picture to the disk.
bool is_about_room(std::string_view line) {
  const auto says = [&](std::string_view words) { return line.find(words) != std::string_view::npos; };
  return says("No space left on device") || says("Disk quota exceeded") || says("Error writing tile");
}

std::string without_digits(std::string_view line) {
  std::string text;
  std::copy_if(line.begin(), line.end(), std::back_inserter(text),
               [](unsigned char c) { return std::isdigit(c) == 0; });
  return text;
}

}  // namespace

bool LogTail::poll() {
  progressed_ = false;
  for (int chunk = 0; chunk < most_chunks && read_chunk(); ++chunk) {
  }
  return progressed_;
}

/// Returns whether there may be more.
bool LogTail::read_chunk() {
  std::ifstream stream(file_, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(read_));
  if (!stream) return false;
  std::string added(chunk_bytes, '\0');
  stream.read(added.data(), static_cast<std::streamsize>(added.size()));
  added.resize(static_cast<std::size_t>(stream.gcount()));
  read_ += added.size();
  rest_ += added;
  std::size_t start = 0;
  for (std::size_t end = rest_.find('\n'); end != std::string::npos; end = rest_.find('\n', start)) {
    if (read_line(std::string_view(rest_).substr(start, end - start))) progressed_ = true;
    start = end + 1;
  }
  rest_.erase(0, start);
  if (rest_.size() > longest_line) rest_.clear();
  return added.size() == chunk_bytes;
}

bool LogTail::read_line(std::string_view line) {
  if (line.starts_with(event_sign)) {
    event_ = static_cast<int>(number_after(line, event_sign).value_or(0));
    samples_ = 0;
    hears_cycles_ = false;
    doing_.clear();
    said_.clear();
    return false;  // the event itself is
  }
  if (is_about_room(line)) ran_out_of_room_ = true;
  if (is_of_cycles(line)) hears_cycles_ = true;
  if (const auto samples = samples_in(line)) {
    samples_ += *samples;
    return true;
  }
  const std::size_t frame = line.find("Fra:");
  const bool is_status =
      frame == 0 || (frame != std::string_view::npos && line.substr(0, frame).ends_with("| "));
  if (!is_status) return is_new(without_digits(line));
  doing_ = status_in(line.substr(frame));
  return is_new(doing_);
}

bool LogTail::is_new(const std::string& text) {
  return said_.size() < most_lines && said_.insert(std::hash<std::string>{}(text)).second;
}

}  // namespace rnmbake
