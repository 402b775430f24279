// blender/sandbox/sandbox.h - a program that sees of the machine what it was given and nothing else, by
// bubblewrap.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rnmbake {

/// What a sandboxed program sees beside the system's own programs and libraries (/usr, little of /etc).
/// Everything is at the path that it has outside.
struct Sandbox {
  std::vector<std::filesystem::path> read;  // files and folders; what does not exist is passed over
  std::filesystem::path write;              // the one folder that can be written to
  /// A new file in a folder whose other files are not to be touched: it is written into `instead`, a folder
  /// below `write`.
  struct Staged {
    std::filesystem::path file, instead;
  };
  std::optional<Staged> staged = {};
  bool gpu = false;  // devices and what their drivers ask /sys
};

/// `argv` in a sandbox: no network, no other processes, no home folder, nor way to a terminal.
[[nodiscard]] std::vector<std::string> sandboxed(const std::vector<std::string>& argv,
                                                 const Sandbox& sandbox);

/// Variables of ours that a sandboxed program may know: language, time zone, which GPUs.
[[nodiscard]] std::vector<std::pair<std::string, std::optional<std::string>>> sandbox_environment(bool gpu);

/// Error(usage) where `folder`, in which `who` lies, holds a home folder or everybody's temporary files: a
/// sandbox that sees it keeps little out.
void refuse_broad_folder(const std::filesystem::path& folder, const std::string& who);

/// Why this machine has no sandbox, with the remedy; nothing where it has one. Starts bubblewrap.
[[nodiscard]] std::optional<std::string> sandbox_obstacle();

/// Removes links, pipes and the like from a folder that a sandboxed program could write to: whoever follows
/// them reads or writes outside for it. Returns the first one's path within the folder; nothing where there
/// were none.
[[nodiscard]] std::optional<std::string> remove_links(const std::filesystem::path& folder);

}  // namespace rnmbake
