// base/leftovers.h - removes the temporary files and folders that killed runs left behind.
#pragma once

#include <filesystem>
#include <string>

namespace rnmbake {

// Beginnings of their names; the owner's word (base/owner.h) and a random one follow.
inline const std::string leftover_file = ".tmp-", leftover_folder = "rnmbake-";

/// The folder is to stay when its owner has ended; also while that still runs, should it be killed.
void mark_as_kept(const std::filesystem::path& folder);

/// In `folder` and not below it, the first time in this process. Only what belongs to this user and whose
/// owner is known to have ended goes; each removal is logged.
void sweep_leftovers(const std::filesystem::path& folder);

}  // namespace rnmbake
