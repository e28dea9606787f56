#include <csignal>
#include <mutex>

#include "cli/shell/standard_streams.h"

namespace errmap::cli {
namespace {

// Messages may come from any thread of a command.
std::atomic<Host*> current{nullptr};
std::mutex one_at_a_time;

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free,
              "a signal handler may touch lock-free atomics only");

extern "C" void OnSignal(int /*signal*/) { interrupted.store(true); }

// The second signal of a kind ends the program at once. What was ignored when
// the program began (nohup, a job in the background of a script) stays so.
void Catch(int signal) {
  struct sigaction action {};
  if (sigaction(signal, nullptr, &action) != 0 ||
      action.sa_handler == SIG_IGN) {
    return;
  }
  action = {};
  action.sa_handler = OnSignal;
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  sigaction(signal, &action, nullptr);
}

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

const std::atomic<bool>& InstallInterruptFlag() {
  if (const Host* const host = CurrentHost()) {
    return host->stop != nullptr ? *host->stop : interrupted;
  }
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) Catch(signal);
  return interrupted;
}

}  // namespace errmap::cli
