// jobs/jobserver.h - tokens of GNU make's jobserver: processes that a run may have beside its first one.
#pragma once

#include <string_view>

namespace rnmbake {

/// A share of the jobs of the make that started this process. The first process needs no token: make gave its
/// slot with the recipe. Every token goes back: by release(), by the destructor, and where a second signal
/// ends this process (process/stop.h). Only what cannot be caught (SIGKILL) loses them. Thread-safe; one
/// object at a time.
class Jobserver {
 public:
  /// By the last --jobserver-auth=R,W (a pipe, GNU make up to 4.3) or --jobserver-auth=fifo:PATH (4.4) of
  /// MAKEFLAGS. Not connected where there is none, or where make closed the pipe because the recipe's line
  /// neither begins with + nor says $(MAKE).
  explicit Jobserver(std::string_view makeflags);
  /// By the environment.
  Jobserver();
  ~Jobserver();
  Jobserver(const Jobserver&) = delete;
  Jobserver& operator=(const Jobserver&) = delete;

  [[nodiscard]] bool connected() const { return reader_ >= 0; }

  /// Takes a token if one is free at this moment; never waits.
  [[nodiscard]] bool try_acquire();

  /// Gives one back; nothing happens where none is held.
  void release();

  [[nodiscard]] int held() const;

 private:
  int reader_ = -1, writer_ = -1;
};

/// How many of `wanted` processes may run: all where no make says otherwise, else one and a token for each
/// other, which `server` holds then.
[[nodiscard]] int jobs_granted(Jobserver& server, int wanted);

}  // namespace rnmbake
