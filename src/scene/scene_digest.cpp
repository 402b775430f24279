#include "scene/scene_digest.h"

#include "base/hash.h"

#include <set>

namespace rnmbake {

std::string SceneDigest::hash() const {
  std::string all;
  for (const DigestEntry& entry : entries) {
    for (const std::string* text : {&entry.what, &entry.hash}) {
      all += std::to_string(text->size()) + ':' + *text;  // names may hold anything
    }
  }
  return hash128_hex(all);
}

std::vector<std::string> differences(const SceneDigest& before, const SceneDigest& after) {
  std::vector<std::string> sentences;
  auto old = before.entries.begin();
  auto fresh = after.entries.begin();
  while (old != before.entries.end() || fresh != after.entries.end()) {
    const bool is_gone =
        fresh == after.entries.end() || (old != before.entries.end() && old->what < fresh->what);
    const bool is_new = !is_gone && (old == before.entries.end() || fresh->what < old->what);
    if (is_gone) {
      sentences.push_back(old++->what + " is gone");
    } else if (is_new) {
      sentences.push_back(fresh++->what + " is new");
    } else {
      if (old->hash != fresh->hash) sentences.push_back(fresh->what + " changed");
      ++old;
      ++fresh;
    }
  }
  return sentences;
}

void add_inputs(std::vector<InputFile>& files, const std::vector<InputFile>& more) {
  std::set<std::filesystem::path> known;
  for (const InputFile& file : files) known.insert(file.path);
  for (const InputFile& file : more) {
    if (known.insert(file.path).second) files.push_back(file);
  }
}

}  // namespace rnmbake
