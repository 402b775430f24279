// scene/scene_digest.h - fingerprints of all that Cycles could see of a scene, part by part, and what
// differs.
#pragma once

#include <compare>
#include <filesystem>
#include <string>
#include <vector>

namespace rnmbake {

/// One part: "object 'Lamp'", "mesh 'Cube'", "picture 'wall.png'", "scene settings". Two scenes are told
/// apart by `hash`, hexadecimal digits that are compared as they are.
struct DigestEntry {
  std::string what, hash;
  std::vector<std::string> uses = {};  // names of parts that it points to, sorted; in no hash
  auto operator<=>(const DigestEntry&) const = default;
};

/// All parts, sorted by `what`, each once. Where every hash is equal, what Cycles renders is, too, as far as
/// the scene decides it: its settings of samples, bounces and the like are the bake's. Paths, names of files,
/// selection and editors are in none. Empty: not looked at.
struct SceneDigest {
  std::vector<DigestEntry> entries;

  [[nodiscard]] bool empty() const { return entries.empty(); }
  /// Of all parts, as 32 hexadecimal digits.
  [[nodiscard]] std::string hash() const;
};

/// A sentence for each part that is not the same, in the order of their names: "picture 'wall.png' changed",
/// "object 'Lamp' is new", "material 'Brick' is gone".
[[nodiscard]] std::vector<std::string> differences(const SceneDigest& before, const SceneDigest& after);

/// A file that a scene reads.
struct InputFile {
  std::string
      kind;  // "scene", "library", "picture", "volume", "cache", "font", "light profile", "script", ...
  std::filesystem::path path;  // absolute
  bool was_there = true;
  auto operator<=>(const InputFile&) const = default;
};

/// Adds those that `files` does not hold yet. Keeps the order; a path is there once, with its first kind.
void add_inputs(std::vector<InputFile>& files, const std::vector<InputFile>& more);

}  // namespace rnmbake
