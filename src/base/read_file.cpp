#include "base/read_file.h"

#include "base/error.h"
#include "base/files.h"
#include "base/machine.h"
#include "base/text.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace rnmbake {

namespace fs = std::filesystem;

namespace {

/// A regular file open for reading. Error(io) where it cannot be: asked of the open file, which nobody can
/// exchange, and without waiting for the writer of a pipe.
class OpenFile {
 public:
  explicit OpenFile(const fs::path& path) : path_(path) {
    descriptor_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    struct stat facts {};
    if (descriptor_ < 0 || ::fstat(descriptor_, &facts) != 0)
      refuse(std::string(std::strerror(errno)) + (errno == ENOENT ? "; check the path" : ""));
    if (S_ISDIR(facts.st_mode)) refuse("it is a folder");
    if (!S_ISREG(facts.st_mode)) refuse("it is a pipe, a device or a socket; give a regular file");
    size_ = static_cast<std::uintmax_t>(facts.st_size);
  }
  ~OpenFile() { close(); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  [[nodiscard]] std::uintmax_t size() const { return size_; }

  /// Fewer bytes where the file has become shorter.
  [[nodiscard]] std::string read(std::uintmax_t offset, std::uintmax_t bytes) const try {
    std::string text(bytes, '\0');
    std::size_t have = 0;
    while (have < text.size()) {
      const ssize_t got =
          ::pread(descriptor_, text.data() + have, text.size() - have, static_cast<off_t>(offset + have));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0)
        fail(ExitCode::io, "cannot read {}: {}", path_.string(), std::string(std::strerror(errno)));
      if (got == 0) break;
      have += static_cast<std::size_t>(got);
    }
    text.resize(have);
    return text;
  } catch (const std::bad_alloc&) {
    fail(ExitCode::io, "cannot read {}: memory does not suffice for its {} bytes", path_.string(), bytes);
  }

 private:
  void close() {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
  }
  [[noreturn]] void refuse(const std::string& why) {
    close();
    fail(ExitCode::io, "cannot read {}: {}", path_.string(), why);
  }

  const fs::path& path_;
  int descriptor_ = -1;
  std::uintmax_t size_ = 0;
};

}  // namespace

std::string read_text(const fs::path& path) {
  return read_text(path, largest_text);
}

std::string read_text(const fs::path& path, std::uintmax_t largest) {
  const OpenFile file(path);
  if (file.size() > largest) {
    fail(ExitCode::io, "cannot read {}: it has {} bytes, more than the {} that such a file may have",
         path.string(), file.size(), largest);
  }
  return file.read(0, file.size());
}

std::string read_data(const fs::path& path) {
  const OpenFile file(path);
  if (file.size() > usable_memory()) {
    fail(ExitCode::io, "cannot read {}: it has {} bytes, more than this machine's memory", path.string(),
         file.size());
  }
  return file.read(0, file.size());
}

void require_regular_file(const fs::path& path) {
  (void)OpenFile(path);
}

std::optional<fs::path> file_inside(const fs::path& folder, const std::string& name) {
  const fs::path relative(name);
  const bool plain = !name.empty() && relative.filename() == relative && name != "." && name != "..";
  if (!plain || printable(name) != name) return std::nullopt;
  return folder / relative;
}

std::string read_tail(const fs::path& path, std::size_t bytes) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return "";
  const OpenFile file(path);
  const std::uintmax_t start = file.size() > bytes ? file.size() - bytes : 0;
  std::string text = file.read(start, file.size() - start);
  if (start == 0) return text;
  const std::size_t line_end = text.find('\n');
  return line_end == std::string::npos ? text : text.substr(line_end + 1);
}

std::string read_part(const fs::path& path, std::uintmax_t offset, std::size_t bytes) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return "";
  const OpenFile file(path);
  if (offset >= file.size()) return "";
  return file.read(offset, std::min<std::uintmax_t>(bytes, file.size() - offset));
}

}  // namespace rnmbake
