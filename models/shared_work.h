#pragma once

#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace errmap::models {

/// Results that several recipes need for the same training rows. Each is made
/// once, by the first recipe that asks; the others wait. A result must depend
/// on its key and the rows alone. Making it must neither ask for the same key
/// nor run other fits meanwhile. Safe to use from several threads.
class SharedWork {
 public:
  /// True if every penalty of a basis will be asked for, as blends do: one pass
  /// over the rows then makes them all.
  bool every_penalty = false;

  template <typename Result>
  std::shared_ptr<const Result> Get(
      const std::string& key,
      const std::function<std::shared_ptr<const Result>()>& make) {
    std::promise<std::shared_ptr<const void>> promise;
    std::shared_future<std::shared_ptr<const void>> result;
    bool is_mine = false;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      const auto found = results_.find(key);
      if (found != results_.end()) {
        result = found->second;
      } else {
        is_mine = true;
        result = promise.get_future().share();
        results_.emplace(key, result);
      }
    }
    if (is_mine) {
      try {
        promise.set_value(make());
      } catch (...) {
        promise.set_exception(std::current_exception());
      }
    }
    return std::static_pointer_cast<const Result>(result.get());
  }

  /// As Get, for results that are large and can be made again quickly: kept
  /// only while somebody holds them.
  template <typename Result>
  std::shared_ptr<const Result> GetWhileHeld(
      const std::string& key,
      const std::function<std::shared_ptr<const Result>()>& make) {
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
    }
    return result;
  }

 private:
  struct Held {
    std::mutex mutex;
    std::weak_ptr<const void> result;
  };

  std::mutex mutex_;
  std::map<std::string, Held> held_;
  std::map<std::string, std::shared_future<std::shared_ptr<const void>>>
      results_;
};

}  // namespace errmap::models
