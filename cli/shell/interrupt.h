#pragma once

#include <atomic>

namespace errmap::cli {

/// Turns Ctrl-C (SIGINT), SIGTERM and SIGHUP (a terminal that closes) into a
/// flag that fits look at; a second signal ends the program at once, and one
/// that was ignored when the program began stays ignored.
const std::atomic<bool>& InstallInterruptFlag();

}  // namespace errmap::cli
