#pragma once

#include <atomic>

namespace errmap::cli {

/// Turns Ctrl-C (SIGINT) and SIGTERM into a flag that fits look at; a second
/// signal ends the program as usual.
const std::atomic<bool>& InstallInterruptFlag();

}  // namespace errmap::cli
