#include "jobs/entry.h"

#include "base/hash.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <spdlog/fmt/fmt.h>
#include <sys/stat.h>
#include <unistd.h>

namespace rnmbake {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view magic = "rnmbake-result", format_version = "1";
constexpr std::size_t longest_header = 160;

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

FileState state_of(const struct stat& status) {
  return {status.st_dev, status.st_ino, status.st_size,
          std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec};
}

/// ESTALE: removed by another machine while it was open.
bool means_absent(int error) {
  return error == ENOENT || error == ENOTDIR || error == ESTALE;
}

/// 0 or errno. A file that shrinks while it is read comes out short.
int read_all(int descriptor, std::string& bytes) {
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t got = ::read(descriptor, bytes.data() + filled, bytes.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return errno;
    if (got == 0) break;
    filled += static_cast<std::size_t>(got);
  }
  bytes.resize(filled);
  return 0;
}

/// Words of a header; all empty where there are not six of them.
std::array<std::string_view, 6> words_of(std::string_view line) {
  std::array<std::string_view, 6> words;
  std::size_t count = 0;
  for (std::size_t begin = 0; begin <= line.size(); ++count) {
    const std::size_t end = std::min(line.find(' ', begin), line.size());
    if (count == words.size()) return {};
    words[count] = line.substr(begin, end - begin);
    begin = end + 1;
  }
  return count == words.size() ? words : std::array<std::string_view, 6>{};
}

/// What is wrong with a file; "": nothing, and the payload begins at `begin`.
std::string damage_of(std::string_view file, const ResultKey& key, std::size_t& begin) {
  if (file.empty()) return "it is empty";
  const std::size_t end = file.substr(0, longest_header).find('\n');
  const bool has_magic = file.substr(0, magic.size()) == magic;
  if (!has_magic) return "it is no result of rnmbake";
  if (end == std::string_view::npos) return "it is cut off within its header";
  const auto [name, version, kind, digits, length, hash] = words_of(file.substr(0, end));
  if (version.empty()) return "its header cannot be read";
  if (version != format_version)
    return fmt::format("it is of format {}, and this is format {}", version, format_version);
  if (kind != key.kind || digits != key.digits) return fmt::format("it is the result {}/{}", kind, digits);
  begin = end + 1;
  std::uint64_t bytes = 0;
  const auto parsed = std::from_chars(length.data(), length.data() + length.size(), bytes);
  if (parsed.ec != std::errc() || parsed.ptr != length.data() + length.size())
    return "its header cannot be read";
  const std::uint64_t present = file.size() - begin;
  if (present < bytes) return fmt::format("it is cut off: {} of {} bytes are there", present, bytes);
  if (present > bytes) return fmt::format("it has {} bytes, not {}", present, bytes);
  if (hash128_hex(file.substr(begin)) != hash) return "its bytes are not those that were written";
  return "";
}

std::string reason_of(int error) {
  return std::strerror(error);  // NOLINT(concurrency-mt-unsafe): glibc's is thread-safe for known errors
}

}  // namespace

std::string entry_header(const ResultKey& key, std::string_view payload) {
  return fmt::format("{} {} {} {} {} {}\n", magic, format_version, key.kind, key.digits, payload.size(),
                     hash128_hex(payload));
}

std::optional<FileState> file_state(const fs::path& file) {
  struct stat status {};
  if (::lstat(file.c_str(), &status) != 0) return std::nullopt;
  return state_of(status);
}

EntryRead read_entry(const fs::path& file, const ResultKey& key) {
  EntryRead result;
  // Without waiting: a pipe in the file's place would never open.
  const Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  if (descriptor.number() < 0) {
    const int error = errno;
    if (error == ELOOP || error == ENXIO) {
      result.damage = "it is no regular file";
      result.state = file_state(file).value_or(FileState{});
    } else if (!means_absent(error)) {
      result.unreadable = reason_of(error);
    }
    return result;
  }
  struct stat status {};
  if (::fstat(descriptor.number(), &status) != 0) return result;
  result.state = state_of(status);
  if (!S_ISREG(status.st_mode)) {
    result.damage = "it is no regular file";
    return result;
  }
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  if (const int error = read_all(descriptor.number(), bytes); error != 0) {
    if (!means_absent(error)) result.unreadable = reason_of(error);
    return result;
  }
  std::size_t begin = 0;
  result.damage = damage_of(bytes, key, begin);
  if (result.damage.empty()) result.payload = std::move(bytes.erase(0, begin));
  return result;
}

void remove_entry(const fs::path& file, const FileState& damaged) {
  if (file_state(file) == damaged) ::unlink(file.c_str());
}

}  // namespace rnmbake
