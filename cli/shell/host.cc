#include "cli/shell/host.h"

#include <mutex>

namespace errmap::cli {
namespace {

// Messages may come from any thread of a command.
std::atomic<Host*> current{nullptr};
std::mutex one_at_a_time;

}  // namespace

Host* CurrentHost() { return current.load(); }

HostedRun::HostedRun(Host* host) {
  one_at_a_time.lock();
  current = host;
}

HostedRun::~HostedRun() {
  current = nullptr;
  one_at_a_time.unlock();
}

}  // namespace errmap::cli
