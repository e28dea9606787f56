#pragma once

#include <atomic>
#include <stdexcept>

namespace errmap::fitting {

/// Thrown if a computation is interrupted from outside. Derives from the type
/// of a caller's mistake, so that callers may report both in the same way.
class Interrupted : public std::invalid_argument {
 public:
  Interrupted() : std::invalid_argument("interrupted") {}
};

/// While it exists, fits and other long computations of this thread check
/// `stop`. So do the threads of a ParallelFor started in it. If `stop` is null,
/// they check that of the enclosing scope. The scope must outlive these
/// threads, and `stop` the scope.
class InterruptionScope {
 public:
  explicit InterruptionScope(const std::atomic<bool>* stop);
  ~InterruptionScope();
  InterruptionScope(const InterruptionScope&) = delete;
  InterruptionScope& operator=(const InterruptionScope&) = delete;

  /// Returns the token of this thread's scope, or null. For its helper threads.
  static const std::atomic<bool>* Token();

 private:
  const std::atomic<bool>* outer_;
};

/// Returns true if the scope's token is set. Call it every tenth of a second:
/// users are promised a response within half a second.
bool IsInterrupted();
/// Throws Interrupted if the token is set.
void ThrowIfInterrupted();

}  // namespace errmap::fitting
