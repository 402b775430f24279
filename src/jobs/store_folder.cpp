#include "jobs/store_folder.h"

#include "base/error.h"
#include "base/files.h"
#include "base/leftovers.h"
#include "jobs/entry.h"
#include "jobs/size_estimate.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <system_error>

namespace rnmbake {

namespace fs = std::filesystem;

namespace {

constexpr const char* tag_name = "CACHEDIR.TAG";
constexpr std::string_view tag_beginning =
    "Signature: 8a477f597d28d172789f06886806bc55\n"  // of every CACHEDIR.TAG
    "# rnmbake cache, format ";
constexpr std::string_view tag_ending =
    "1\n"
    "# Results that rnmbake keeps so that it need not make them again. The whole folder may be deleted.\n"
    "# About this file: https://bford.info/cachedir/\n";

std::string beginning_of(const fs::path& file) {
  std::string bytes(tag_beginning.size() + 2, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

bool is_temporary(const std::string& name) {
  return name.rfind(leftover_file, 0) == 0;
}

bool is_hexadecimal(const std::string& text, std::size_t digits) {
  return text.size() == digits && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

/// Whether a name stands in the folder that is not a temporary file's: those may be of a process that makes
/// the CACHEDIR.TAG right now.
bool holds_something(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (!is_temporary(it->path().filename().string())) return true;
  }
  if (error && error != std::errc::no_such_file_or_directory)
    fail(ExitCode::io, "cannot read the folder {}: {}", folder.string(), error.message());
  return false;
}

class Lister {
 public:
  explicit Lister(fs::path folder) : folder_(std::move(folder)) {}

  StoreContents list() {
    each_in(folder_, [&](const fs::path& path, const std::string& name, bool is_folder) {
      if (is_folder && is_result_kind(name)) {
        list_kind(path, name);
      } else if (name != tag_name && name != SizeEstimate::file_name) {
        ++found_.others;
      }
    });
    std::sort(found_.results.begin(), found_.results.end(),
              [](const StoredResult& a, const StoredResult& b) { return a.key < b.key; });
    return std::move(found_);
  }

 private:
  void list_kind(const fs::path& folder, const std::string& kind) {
    each_in(folder, [&](const fs::path& path, const std::string& name, bool is_folder) {
      if (is_folder && is_hexadecimal(name, 2)) {
        list_entries(path, kind, name);
      } else {
        ++found_.others;
      }
    });
  }

  void list_entries(const fs::path& folder, const std::string& kind, const std::string& beginning) {
    each_in(folder, [&](const fs::path& path, const std::string& name, bool is_folder) {
      if (is_folder || !is_hexadecimal(name, 32) || name.substr(0, 2) != beginning) {
        ++found_.others;
        return;
      }
      const auto state = file_state(path);
      if (!state) return;
      found_.results.push_back({{kind, name}, path, state->bytes, state->modified});
      found_.bytes += state->bytes;
    });
  }

  void each_in(const fs::path& folder,
               const std::function<void(const fs::path&, const std::string& name, bool is_folder)>& take) {
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
      const std::string name = it->path().filename().string();
      std::error_code gone;
      const bool is_folder = it->is_directory(gone) && !it->is_symlink(gone);
      if (is_temporary(name) && !is_folder) {
        found_.temporary.push_back(it->path());
      } else {
        take(it->path(), name, is_folder);
      }
    }
    if (error && error != std::errc::no_such_file_or_directory)
      found_.unreadable.push_back(folder.string() + ": " + error.message());
  }

  fs::path folder_;
  StoreContents found_;
};

}  // namespace

StoreFolder look_at_store_folder(const fs::path& folder) {
  for (int attempt = 0; attempt < 2; ++attempt) {
    const std::string tag = beginning_of(folder / tag_name);
    if (tag == fmt::format("{}{}", tag_beginning, tag_ending.substr(0, 2))) return StoreFolder::ours;
    if (tag.rfind(tag_beginning, 0) == 0) return StoreFolder::other;
    if (!holds_something(folder)) return StoreFolder::absent;
    // Again: another process may have made it a store between these two looks.
  }
  return StoreFolder::foreign;
}

void make_store_folder(const fs::path& folder) {
  make_folders(folder);
  write_atomically(folder / tag_name, fmt::format("{}{}", tag_beginning, tag_ending));
  sync_folder(fs::absolute(folder).parent_path());
}

void require_store_folder(const fs::path& folder) {
  switch (look_at_store_folder(folder)) {
    case StoreFolder::absent:
    case StoreFolder::ours:
      return;
    case StoreFolder::other:
      fail(ExitCode::usage,
           "{} is a cache of another version of rnmbake; name another folder with --cache, or delete it",
           folder.string());
    case StoreFolder::foreign:
      break;
  }
  fail(ExitCode::usage,
       "{} is no cache of rnmbake (it is not empty and has no {} of ours); name a new or empty folder with "
       "--cache",
       folder.string(), tag_name);
}

fs::path entry_path(const fs::path& folder, const ResultKey& key) {
  return folder / key.kind / key.digits.substr(0, 2) / key.digits;
}

StoreContents list_store(const fs::path& folder) {
  return Lister(folder).list();
}

}  // namespace rnmbake
