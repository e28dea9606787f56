#pragma once

#include <atomic>

namespace errmap::cli {

/// Turns Ctrl-C (SIGINT), SIGTERM and SIGHUP (a closed terminal) into a flag
/// that fits check. A second signal ends the program at once. A signal that was
/// ignored at the program's start stays ignored.
const std::atomic<bool>& InstallInterruptFlag();

}  // namespace errmap::cli
