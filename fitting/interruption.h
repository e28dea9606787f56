#pragma once

#include <atomic>
#include <stdexcept>

namespace errmap::fitting {

/// Thrown where a computation is broken off from outside. A caller's mistake
/// has the same type: whoever has no map yet reports both alike.
class Interrupted : public std::invalid_argument {
 public:
  Interrupted() : std::invalid_argument("interrupted") {}
};

/// While it lives, long computations of this thread that are not told of a stop
/// token (products, factorisations, refinements) look at `stop`; null: at that
/// of the scope around it. Must outlive what it is made for, `stop` both.
class InterruptionScope {
 public:
  explicit InterruptionScope(const std::atomic<bool>* stop);
  ~InterruptionScope();
  InterruptionScope(const InterruptionScope&) = delete;
  InterruptionScope& operator=(const InterruptionScope&) = delete;

 private:
  const std::atomic<bool>* outer_;
};

/// Throws Interrupted where the scope's token is set. To be called every tenth
/// of a second: an answer within half a second is what users are promised.
void ThrowIfInterrupted();

}  // namespace errmap::fitting
