#include "config/parse_toml.h"

#include <algorithm>
#include <optional>

namespace rnmbake {
namespace {

constexpr int most_key_parts = 16;

/// Walks over TOML and passes over what is in quotes and comments.
class KeyWalk {
 public:
  explicit KeyWalk(std::string_view text) : text_(text) {}

  /// The line of the first key with too many parts. Of numbers, too, whose dots are fewer.
  std::optional<long> too_deep() {
    int dots = 0;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '"' || c == '\'') {
        pass_quoted(c);
        continue;
      }
      if (c == '#') at_ = std::min(text_.find('\n', at_), text_.size()) - 1;
      if (c == '.' && ++dots >= most_key_parts) return line();
      if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos) dots = 0;
      ++at_;
    }
    return std::nullopt;
  }

 private:
  /// 'text', "text", or three quotes for texts of several lines.
  void pass_quoted(char quote) {
    const std::string three(3, quote);
    const bool several_lines = text_.substr(at_, 3) == three;
    const std::string end = several_lines ? three : std::string(1, quote);
    at_ += end.size();
    while (at_ < text_.size() && text_.substr(at_, end.size()) != end) {
      if (text_[at_] == '\n' && !several_lines) return;  // no TOML; the parser says so
      at_ += text_[at_] == '\\' && quote == '"' ? 2 : 1;
    }
    at_ += end.size();
    while (several_lines && at_ < text_.size() && text_[at_] == quote) ++at_;  // up to two may end the text
  }

  [[nodiscard]] long line() const { return 1 + std::count(text_.begin(), text_.begin() + long(at_), '\n'); }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& file, ExitCode code) {
  if (const auto line = KeyWalk(text).too_deep())
    fail(code, "{}:{}: a key of more than {} parts; no setting has so many", file, *line, most_key_parts);
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    fail(code, "{}:{}: not TOML: {}", file, error.source().begin.line, error.description());
  }
}

}  // namespace rnmbake
