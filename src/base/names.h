// base/names.h - names that people gave things: made safe for files, matched by globs, guessed when mistyped.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace rnmbake {

/// Hands out file stems, no two of which are the same file on any file system: neither where case is ignored
/// nor where names are normalised (base/utf8: fold_case).
class FileStems {
 public:
  static constexpr std::size_t max_bytes = 120;

  FileStems() = default;
  /// Files of these stems are there already.
  explicit FileStems(const std::vector<std::string>& taken);

  /// `name` itself where it is harmless: no separator, no "..", no control character, no leading dot or dash,
  /// not reserved by Windows, valid UTF-8, at most max_bytes, not given out before. Else a harmless version
  /// of it with a short hash of the name appended. Depends on the order of the calls only on collision.
  std::string take(std::string_view name);

 private:
  std::set<std::string> taken_;  // folded
};

/// "rnm-squared" of "RNM, squared": a-z and 0-9, with a dash for all between; of a label of our own, for a
/// file.
std::string file_word(std::string_view label);

/// The candidate closest to `word` by edit distance (insert, delete, replace, swap neighbours; case is
/// ignored), if it is close enough to be a slip of the finger.
std::optional<std::string> nearest_name(std::string_view word, const std::vector<std::string>& candidates);

/// ", did you mean 'x'?" or nothing; to be appended to a message.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

/// The whole of `text` against a shell pattern: * any run, ? one character (UTF-8), [abc], [a-z], [!abc].
/// Everything else, "/" and a leading dot included, stands for itself.
bool glob_match(std::string_view pattern, std::string_view text);

}  // namespace rnmbake
