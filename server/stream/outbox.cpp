#include "outbox.h"

#include <algorithm>
#include <utility>

namespace sluice::stream {

void Outbox::hold() {
  const std::lock_guard lock(mutex_);
  held_ = true;
}

void Outbox::release(WireMessage welcome) {
  const std::lock_guard lock(mutex_);
  held_ = false;
  if (closing_ || !welcome) return;
  replyBytes_ += welcome->size();
  replies_.push_front({std::move(welcome), 0, 0});
}

SendResult Outbox::pushReply(WireMessage message, std::uint64_t inReplyTo) {
  const std::lock_guard lock(mutex_);
  if (closing_) return SendResult::Gone;
  if (replies_.size() >= limits_.replies || replyBytes_ + message->size() > limits_.replyBytes) {
    closeLocked({CloseCode::PolicyViolation, "too many messages wait to be read"});
    return SendResult::Overflow;
  }
  replyBytes_ += message->size();
  replies_.push_back({std::move(message), inReplyTo, ++pushes_});
  return queued();
}

SendResult Outbox::pushLatest(Latest kind, WireMessage message) {
  WireMessage replaced;  // Destroyed outside the lock.
  const std::lock_guard lock(mutex_);
  if (closing_) return SendResult::Gone;
  LatestMessage& slot = latest_[static_cast<std::size_t>(kind)];
  if (!slot.message) slot.order = ++pushes_;
  replaced = std::exchange(slot.message, std::move(message));
  return replaced ? SendResult::Replaced : queued();
}

SendResult Outbox::pushFrame(std::uint64_t frameId, WireMessage message) {
  const std::lock_guard lock(mutex_);
  if (closing_) return SendResult::Gone;
  if (frames_.size() + unacknowledged_.size() >= limits_.frameWindow) return SendResult::Dropped;
  frames_.push_back({frameId, std::move(message)});
  return queued();
}

bool Outbox::acknowledge(std::uint64_t frameId) {
  const std::lock_guard lock(mutex_);
  const auto frame = std::find(unacknowledged_.begin(), unacknowledged_.end(), frameId);
  if (frame == unacknowledged_.end()) return false;
  unacknowledged_.erase(unacknowledged_.begin(), frame + 1);
  return true;
}

bool Outbox::admitSnapshot(std::uint64_t sequence) {
  const std::lock_guard lock(mutex_);
  if (snapshots_.size() >= limits_.snapshots) return false;
  snapshots_.push_back(sequence);
  return true;
}

void Outbox::close(CloseReason reason) {
  const std::lock_guard lock(mutex_);
  closeLocked(std::move(reason));
}

bool Outbox::closed() const {
  const std::lock_guard lock(mutex_);
  return closing_.has_value();
}

std::optional<Outbox::Item> Outbox::next() {
  const std::lock_guard lock(mutex_);
  std::optional<Item> item = takeLocked();
  writerWaits_ = !item;
  return item;
}

std::optional<Outbox::Item> Outbox::takeLocked() {
  if (closing_) {
    if (std::exchange(closeTaken_, true)) return std::nullopt;
    return *closing_;
  }
  if (held_) return std::nullopt;
  LatestMessage* latest = firstLatest();
  if (latest != nullptr && (replies_.empty() || latest->order < replies_.front().order)) {
    return std::exchange(latest->message, nullptr);
  }
  if (!replies_.empty()) return takeReply();
  if (!frames_.empty()) {
    QueuedFrame frame = std::move(frames_.front());
    frames_.pop_front();
    unacknowledged_.push_back(frame.id);
    return std::move(frame.message);
  }
  return std::nullopt;
}

Outbox::LatestMessage* Outbox::firstLatest() {
  LatestMessage* first = nullptr;
  for (LatestMessage& slot : latest_) {
    if (slot.message && (first == nullptr || slot.order < first->order)) first = &slot;
  }
  return first;
}

WireMessage Outbox::takeReply() {
  Reply reply = std::move(replies_.front());
  replies_.pop_front();
  replyBytes_ -= reply.message->size();
  std::erase(snapshots_, reply.inReplyTo);
  return std::move(reply.message);
}

SendResult Outbox::queued() {
  if (held_ || !std::exchange(writerWaits_, false)) return SendResult::Queued;
  return SendResult::Sent;
}

void Outbox::closeLocked(CloseReason reason) {
  if (closing_) return;
  closing_ = std::move(reason);
  replies_.clear();
  replyBytes_ = 0;
  latest_ = {};
  frames_.clear();
  snapshots_.clear();
}

}  // namespace sluice::stream
