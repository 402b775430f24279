// base/object_notes.h - what is said of many objects at once, said once.
#pragma once

#include "base/log.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rnmbake {

/// Collects messages about objects; those that say the same make one line, "a, b, c and 134 more: said".
class ObjectNotes {
 public:
  explicit ObjectNotes(log::Level level) : level_(level) {}

  /// `detail` is what to say of the object alone, such as `said` with a number; empty: `said`.
  void add(std::string object, std::string said, std::string detail = "");

  /// A message that begins with the object's name: "floor: said". Others are a line of their own.
  void add_line(std::string_view line);

  /// One line for each thing said, in the order of their first; with -v the details of each object, too.
  void write();

  /// What write() says on its level.
  [[nodiscard]] std::vector<std::string> lines() const;

 private:
  struct Note {
    std::string said;
    std::vector<std::string> objects, details;
  };
  log::Level level_;
  std::vector<Note> notes_;
};

/// Lines that begin with their objects' names, as warnings.
void warn_of_objects(const std::vector<std::string>& lines);

/// "a", "a and b", "a, b and c"; of more than `most`: "a, b, c and 2 more".
std::string first_names(const std::vector<std::string>& names, std::size_t most = 3);

}  // namespace rnmbake
