#pragma once

#include <atomic>
#include <string>
#include <vector>

namespace errmap::cli {

/// Replaces the streams and signals of the process if another program runs
/// commands (RunHosted).
struct Host {
  const std::atomic<bool>* stop = nullptr;  // set: a command ends early
  std::string printed = {};                 // to standard output
  std::vector<std::string> messages = {};   // without "errmap: "
};

/// Returns null if the process is errmap's own.
Host* CurrentHost();

/// Makes `host` the current one for its lifetime; only one at a time.
class HostedRun {
 public:
  explicit HostedRun(Host* host);
  ~HostedRun();
  HostedRun(const HostedRun&) = delete;
  HostedRun& operator=(const HostedRun&) = delete;
};

}  // namespace errmap::cli
