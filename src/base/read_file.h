// base/read_file.h - files that others made: regular ones, of a size that their kind may have.
//
// read_text() of base/files.h is the usual way to one; these are for other sizes and parts.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace rnmbake {

/// What read_text() takes without being told: a manifest of 100,000 objects has 200 MB.
constexpr std::uintmax_t largest_text = std::uintmax_t{512} << 20;

/// The whole file. Error(io) if it cannot be read, is no regular file (pipes and devices may never end) or is
/// larger than `largest`.
std::string read_text(const std::filesystem::path& path, std::uintmax_t largest);

/// The whole file, however large; Error(io) as above, also where the machine has not the memory for it.
std::string read_data(const std::filesystem::path& path);

/// At most `bytes` bytes from `offset` on; empty if there is no such file, or no more of it.
std::string read_part(const std::filesystem::path& path, std::uintmax_t offset, std::size_t bytes);

/// Error(io) where read_text() would refuse to open the file; for libraries that open a path themselves.
void require_regular_file(const std::filesystem::path& path);

/// The file of that name in `folder`; nullopt where the name is no plain one: empty, a path, with control
/// characters. For names that a file brings along, so that they never lead out of its folder.
std::optional<std::filesystem::path> file_inside(const std::filesystem::path& folder,
                                                 const std::string& name);

}  // namespace rnmbake
