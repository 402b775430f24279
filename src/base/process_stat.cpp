#include "base/process_stat.h"

#include <array>
#include <fstream>
#include <sstream>
#include <string>

#include <unistd.h>

namespace rnmbake {

// proc(5). The name (field 2) may hold spaces and brackets, so count from the last ")".
std::optional<ProcessStat> read_process_stat(const std::filesystem::path& folder) {
  std::ifstream stream(folder / "stat");
  std::array<char, 4096> buffer{};
  stream.read(buffer.data(), buffer.size());  // sets badbit where the process is gone; iterators would throw
  const std::string text(buffer.data(), static_cast<std::size_t>(stream.gcount()));
  const std::size_t name_end = text.rfind(')');
  if (name_end == std::string::npos) return std::nullopt;
  std::istringstream fields(text.substr(name_end + 1));
  std::string skipped;
  double ticks[4] = {};
  long long resident_pages = 0;
  ProcessStat stat;
  fields >> stat.state >> stat.parent >> stat.group >> stat.session;  // 3 to 6
  for (int i = 7; i <= 13; ++i) fields >> skipped;                    // up to cmajflt
  for (double& t : ticks) fields >> t;               // 14 to 17: utime, stime, cutime, cstime
  for (int i = 18; i <= 21; ++i) fields >> skipped;  // up to itrealvalue
  fields >> stat.start_ticks >> skipped >> resident_pages;
  if (!fields) return std::nullopt;
  stat.cpu_seconds = (ticks[0] + ticks[1] + ticks[2] + ticks[3]) / static_cast<double>(sysconf(_SC_CLK_TCK));
  stat.resident_bytes = static_cast<std::size_t>(resident_pages * sysconf(_SC_PAGESIZE));
  return stat;
}

}  // namespace rnmbake
