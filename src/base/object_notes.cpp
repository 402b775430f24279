#include "base/object_notes.h"

#include <algorithm>
#include <utility>

namespace rnmbake {
namespace {

std::string line_of(const std::string& object, const std::string& said) {
  return object.empty() ? said : object + ": " + said;
}

}  // namespace

void ObjectNotes::add(std::string object, std::string said, std::string detail) {
  auto note = std::ranges::find(notes_, said, &Note::said);
  if (note == notes_.end()) note = notes_.insert(note, Note{said, {}, {}});
  note->objects.push_back(std::move(object));
  note->details.push_back(detail.empty() ? std::move(said) : std::move(detail));
}

void ObjectNotes::add_line(std::string_view line) {
  const std::size_t colon = line.find(": ");
  if (colon == std::string_view::npos) return add("", std::string(line));
  add(std::string(line.substr(0, colon)), std::string(line.substr(colon + 2)));
}

std::vector<std::string> ObjectNotes::lines() const {
  std::vector<std::string> lines;
  for (const Note& note : notes_) {
    const bool alone = note.objects.size() == 1;
    lines.push_back(line_of(first_names(note.objects), alone ? note.details.front() : note.said));
  }
  return lines;
}

void ObjectNotes::write() {
  for (const std::string& line : lines()) log::write(level_, line);
  for (const Note& note : notes_) {
    if (note.objects.size() == 1) continue;
    for (std::size_t i = 0; i < note.objects.size(); ++i)
      log::debug("{}", line_of(note.objects[i], note.details[i]));
  }
  notes_.clear();
}

void warn_of_objects(const std::vector<std::string>& lines) {
  ObjectNotes notes(log::Level::warning);
  for (const std::string& line : lines) notes.add_line(line);
  notes.write();
}

std::string first_names(const std::vector<std::string>& names, std::size_t most) {
  const std::size_t shown = std::min(names.size(), most), more = names.size() - shown;
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) {
    const bool last = i + 1 == shown && more == 0;
    text += (i == 0 ? "" : last ? " and " : ", ") + names[i];
  }
  return more == 0 ? text : text + fmt::format(" and {} more", more);
}

}  // namespace rnmbake
