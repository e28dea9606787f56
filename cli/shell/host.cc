#include "cli/shell/host.h"

#include <mutex>

#include "cli/shell/standard_streams.h"

namespace errmap::cli {
namespace {

// Messages may come from any thread of a command.
std::atomic<Host*> current{nullptr};
std::mutex one_at_a_time;

}  // namespace

Host* CurrentHost() { return current.load(); }

HostedRun::HostedRun(Host* host) {
  one_at_a_time.lock();
  AdviseAny();  // the command before had options of its own
  current = host;
}

HostedRun::~HostedRun() {
  current = nullptr;
  one_at_a_time.unlock();
}

}  // namespace errmap::cli
