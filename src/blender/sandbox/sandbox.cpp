#include "blender/sandbox/sandbox.h"

#include "base/error.h"
#include "base/files.h"
#include "process/run.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <string_view>

extern char** environ;  // NOLINT(readability-redundant-declaration): not every libc declares it

namespace rnmbake {

namespace fs = std::filesystem;

namespace {

constexpr const char* program = "bwrap";
constexpr double answer_seconds = 20;

/// Namespaces of its own, no rights in them, no way to a terminal, and an end when we end.
const std::vector<std::string>& walls() {
  static const std::vector<std::string> flags = {"--unshare-user",    "--unshare-all", "--disable-userns",
                                                 "--cap-drop",        "ALL",           "--new-session",
                                                 "--die-with-parent", "--hostname",    "sandbox"};
  return flags;
}

/// Of /etc: where libraries, fonts and GPU drivers are, and the time zone.
constexpr std::array etc_files = {"/etc/ld.so.cache",  "/etc/ld.so.conf", "/etc/ld.so.conf.d",
                                  "/etc/alternatives", "/etc/fonts",      "/etc/localtime",
                                  "/etc/glvnd",        "/etc/vulkan",     "/etc/OpenCL"};
constexpr std::array cpu_files = {"/sys/devices/system/cpu", "/sys/devices/system/node"};
constexpr std::array gpu_files = {"/sys/devices", "/sys/dev",    "/sys/bus/pci",
                                  "/sys/class",   "/sys/module", "/run/nvidia-persistenced"};

using Mounts = std::map<fs::path, std::vector<std::string>>;  // by place: those above come first

void show(Mounts& mounts, const fs::path& path) {
  std::error_code error;
  if (path.empty() || !fs::exists(path, error)) return;
  const fs::path place = fs::absolute(path).lexically_normal();
  const std::string word = place.string();
  mounts[place] = {"--ro-bind", word, word};
  const fs::path real = fs::canonical(path, error);  // what links and absolute paths of the scene name
  if (!error && real != place) mounts[real] = {"--ro-bind", real.string(), real.string()};
}

void add_system(Mounts& mounts, bool gpu) {
  show(mounts, "/usr");
  for (const char* name : {"/bin", "/sbin", "/lib", "/lib32", "/lib64", "/libx32"}) {
    std::error_code error;
    if (fs::is_symlink(name, error)) {
      mounts[name] = {"--symlink", fs::read_symlink(name, error).string(), name};
    } else {
      show(mounts, name);
    }
  }
  for (const char* file : etc_files) mounts[file] = {"--ro-bind-try", file, file};
  for (const char* file : cpu_files) mounts[file] = {"--ro-bind-try", file, file};
  mounts["/proc"] = {"--proc", "/proc"};
  mounts["/dev"] = {"--dev", "/dev"};
  mounts["/etc/mtab"] = {"--symlink", "/proc/self/mounts", "/etc/mtab"};  // Blender warns without it
  if (!gpu) return;
  for (const char* file : gpu_files) mounts[file] = {"--ro-bind-try", file, file};
  mounts["/dev/dri"] = {"--dev-bind-try", "/dev/dri", "/dev/dri"};
  mounts["/dev/kfd"] = {"--dev-bind-try", "/dev/kfd", "/dev/kfd"};
  std::error_code error;
  for (fs::directory_iterator it("/dev", error), end; !error && it != end; it.increment(error)) {
    const std::string device = it->path().string();
    if (device.starts_with("/dev/nvidia")) mounts[device] = {"--dev-bind-try", device, device};
  }
}

/// A folder for what is written, in the place of one whose files stay to be seen where they could be before.
void add_staged(Mounts& mounts, const Sandbox::Staged& staged) {
  const fs::path place = fs::absolute(staged.file).lexically_normal().parent_path();
  const bool was_shown = mounts.contains(place);
  mounts[place] = {"--bind", fs::absolute(staged.instead).string(), place.string()};
  if (!was_shown) return;
  std::error_code error;
  for (fs::directory_iterator it(place, error), end; !error && it != end; it.increment(error)) {
    if (it->path().filename() == staged.file.filename()) continue;
    const std::string path = it->path().string();
    mounts.try_emplace(it->path(), std::vector<std::string>{"--ro-bind", path, path});
  }
}

std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const std::size_t end = text.rfind('\n');
  return end == std::string::npos ? text : text.substr(end + 1);
}

bool is_inside(const fs::path& path, const fs::path& folder) {
  const auto relative = path.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

std::vector<std::string> sandboxed(const std::vector<std::string>& argv, const Sandbox& sandbox) {
  Mounts mounts;
  add_system(mounts, sandbox.gpu);
  for (const fs::path& path : sandbox.read) show(mounts, path);
  const std::string write = fs::absolute(sandbox.write).string();
  mounts[write] = {"--bind", write, write};
  if (sandbox.staged) add_staged(mounts, *sandbox.staged);
  std::vector<std::string> words = {program};
  words.insert(words.end(), walls().begin(), walls().end());
  for (const auto& [place, flags] : mounts) words.insert(words.end(), flags.begin(), flags.end());
  // The folders that bubblewrap made to mount the others in: files there would take memory without limit.
  words.insert(words.end(), {"--remount-ro", "/dev", "--remount-ro", "/", "--chdir", write, "--"});
  words.insert(words.end(), argv.begin(), argv.end());
  return words;
}

std::vector<std::pair<std::string, std::optional<std::string>>> sandbox_environment(bool gpu) {
  std::vector<std::pair<std::string, std::optional<std::string>>> variables = {{"PATH", "/usr/bin:/bin"}};
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text = *entry;
    const std::string name(text.substr(0, text.find('=')));
    const auto begins = [&](const char* beginning) { return name.starts_with(beginning); };
    const bool of_gpu = begins("CUDA_") || begins("HIP_") || begins("ROCR_") || begins("ZE_") ||
                        begins("ONEAPI_") || begins("SYCL_");
    if (name == "LANG" || name == "LANGUAGE" || name == "TZ" || begins("LC_") || (gpu && of_gpu))
      variables.emplace_back(name, std::string(text.substr(std::min(name.size() + 1, text.size()))));
  }
  return variables;
}

void refuse_broad_folder(const fs::path& folder, const std::string& who) {
  std::error_code error;
  const fs::path wide = fs::weakly_canonical(folder, error);
  const char* home = std::getenv("HOME");
  const std::array<std::pair<fs::path, const char*>, 4> kept = {
      {{home != nullptr ? home : "/root", "the home folder"},
       {"/root", "the home folder"},
       {"/home", "home folders"},
       {temp_root(), "everybody's temporary files"}}};
  for (const auto& [path, what] : kept) {
    if (is_inside(fs::weakly_canonical(path, error), wide)) {
      fail(ExitCode::usage,
           "--sandbox: {} lies in {}, and with it the sandbox would see {}; move it to a folder of its own",
           who, wide.string(), what);
    }
  }
}

std::optional<std::string> sandbox_obstacle() {
  ProcessOptions options;
  options.argv = {program};
  options.argv.insert(options.argv.end(), walls().begin(), walls().end());
  for (const char* word : {"--ro-bind", "/", "/", "--proc", "/proc", "--dev", "/dev", "--", "/bin/true"})
    options.argv.emplace_back(word);
  options.total_seconds = answer_seconds;
  try {
    const ProcessResult result = run_process(options);
    if (result.succeeded() || result.ended_by == ProcessResult::EndedBy::stop_request) return std::nullopt;
    return fmt::format(
        "{} makes none here ({}); the kernel has to allow this user namespaces (Debian: sysctl "
        "kernel.unprivileged_userns_clone=1; in Docker: --privileged, or root with --security-opt "
        "seccomp=unconfined)",
        program, last_line(result.output));
  } catch (const Error& error) {
    if (error.code() != ExitCode::environment) throw;
    return fmt::format("{} (bubblewrap) is not installed; Debian, Ubuntu: apt install bubblewrap", program);
  }
}

std::optional<std::string> remove_links(const fs::path& folder) {
  std::optional<std::string> first;
  std::vector<fs::path> strange;
  std::error_code error;
  fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, error), end;
  while (!error && it != end) {
    std::error_code unknown;
    const fs::file_type type = it->symlink_status(unknown).type();
    if (type != fs::file_type::regular && type != fs::file_type::directory) strange.push_back(it->path());
    it.increment(error);
  }
  for (const fs::path& path : strange) {
    if (!first) first = path.lexically_relative(folder).string();
    std::error_code unremoved;
    fs::remove(path, unremoved);
  }
  return first || !error ? first : std::optional<std::string>("a folder that cannot be looked through");
}

}  // namespace rnmbake
