#include "fitting/interruption.h"

namespace errmap::fitting {
namespace {

thread_local const std::atomic<bool>* token = nullptr;

}  // namespace

InterruptionScope::InterruptionScope(const std::atomic<bool>* stop)
    : outer_(token) {
  if (stop != nullptr) token = stop;
}

InterruptionScope::~InterruptionScope() { token = outer_; }

const std::atomic<bool>* InterruptionScope::Token() { return token; }

bool IsInterrupted() {
  return token != nullptr && token->load(std::memory_order_relaxed);
}

void ThrowIfInterrupted() {
  if (IsInterrupted()) throw Interrupted();
}

}  // namespace errmap::fitting
