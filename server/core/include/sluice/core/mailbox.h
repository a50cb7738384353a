#pragma once

#include <memory>
#include <mutex>
#include <utility>

namespace sluice::core {

/// Holds the newest value handed from one thread to another: a put replaces what was not taken yet, so a slow
/// consumer skips and never piles up work. Values are frozen (`shared_ptr<const T>`). All methods are thread-safe.
template <class T>
class Mailbox {
 public:
  using Value = std::shared_ptr<const T>;

  /// Returns true when an untaken value was replaced.
  bool put(Value value) {
    Value replaced;  // destroyed outside the lock
    const std::lock_guard lock(mutex_);
    replaced = std::exchange(value_, std::move(value));
    return replaced != nullptr;
  }

  /// The newest value, leaving the mailbox empty; null when there is none.
  Value take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(value_, nullptr);
  }

  /// The newest value, left in place; null when there is none.
  Value peek() const {
    const std::lock_guard lock(mutex_);
    return value_;
  }

 private:
  mutable std::mutex mutex_;
  Value value_;
};

}  // namespace sluice::core
