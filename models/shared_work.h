#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace errmap::models {

/// Results that several recipes need for the same training rows. The first
/// recipe that asks makes the result; the others wait, and make it themselves
/// if that failed. A result must depend on its key and the rows alone. Making
/// it must neither ask for the same key nor run other fits meanwhile. Safe to
/// use from several threads.
class SharedWork {
 public:
  /// True if every penalty of a basis will be needed, as in blends: one pass
  /// over the rows then makes them all.
  bool every_penalty = false;

  /// How long a result is kept. Large results that are quick to make are kept
  /// only while in use.
  enum class Keep { kAlways, kWhileHeld };

  template <typename Result>
  std::shared_ptr<const Result> Get(
      const std::string& key,
      const std::function<std::shared_ptr<const Result>()>& make,
      Keep keep = Keep::kAlways) {
    Held* held = nullptr;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      held = &held_[key];
    }
    const std::lock_guard<std::mutex> lock(held->mutex);
    auto result = std::static_pointer_cast<const Result>(held->result.lock());
    if (result == nullptr) {
      result = make();
      held->result = result;
      if (keep == Keep::kAlways) held->kept = result;
    }
    return result;
  }

 private:
  struct Held {
    std::mutex mutex;
    std::weak_ptr<const void> result;
    std::shared_ptr<const void> kept;
  };

  std::mutex mutex_;
  std::map<std::string, Held> held_;
};

}  // namespace errmap::models
