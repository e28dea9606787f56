#pragma once

#include <atomic>
#include <stdexcept>

namespace errmap::fitting {

/// Thrown if a computation is interrupted from outside. Derives from the type
/// of a caller's mistake, so that code without a map yet reports both in the
/// same way.
class Interrupted : public std::invalid_argument {
 public:
  Interrupted() : std::invalid_argument("interrupted") {}
};

/// While it exists, fits and other long computations of this thread check
/// `stop`. If null, they check that of the enclosing scope, as do the threads
/// of a ParallelFor begun in it. The scope must outlive them, `stop` the scope.
class InterruptionScope {
 public:
  explicit InterruptionScope(const std::atomic<bool>* stop);
  ~InterruptionScope();
  InterruptionScope(const InterruptionScope&) = delete;
  InterruptionScope& operator=(const InterruptionScope&) = delete;

  /// Returns the token of this thread's scope, or null: for its helpers.
  static const std::atomic<bool>* Token();

 private:
  const std::atomic<bool>* outer_;
};

/// Returns true if the scope's token is set. Ask every tenth of a second: users
/// are promised an answer within half a second.
bool IsInterrupted();
/// Throws Interrupted if it is.
void ThrowIfInterrupted();

}  // namespace errmap::fitting
