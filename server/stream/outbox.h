#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "close_reason.h"
#include "sluice/stream/send_result.h"

namespace sluice::stream {

/// A serialised message, shared by every viewer that is sent the same one.
using WireMessage = std::shared_ptr<const std::string>;

/// What waits to be sent to one viewer, in bounded memory: frames up to the window, one message of each latest-wins
/// kind, and a queue of replies whose overflow ends the connection. Knows no socket. All methods are thread-safe:
/// any thread fills it, the session's writer empties it.
class Outbox {
 public:
  struct Limits {
    std::size_t frameWindow = 2;  ///< Frames neither acknowledged nor refused.
    std::size_t replies = 256;
    /// Two lossless pictures of 3840×2160 and change.
    std::size_t replyBytes = std::size_t{64} << 20U;
    std::size_t snapshots = 2;  ///< Snapshots asked for and not sent yet.
  };

  /// Kinds of which only the newest message counts.
  enum class Latest : std::uint8_t { Stats, Plan };

  using Item = std::variant<WireMessage, CloseReason>;

  explicit Outbox(const Limits& limits) : limits_(limits) {}

  /// Keeps everything back until `release`, which puts the Welcome in front: what is broadcast while the Welcome is
  /// being made follows it. A null Welcome only ends the hold.
  void hold();
  void release(WireMessage welcome);

  /// `inReplyTo` settles the snapshot of that sequence number, if there is one.
  SendResult pushReply(WireMessage message, std::uint64_t inReplyTo = 0);
  SendResult pushLatest(Latest kind, WireMessage message);
  SendResult pushFrame(std::uint64_t frameId, WireMessage message);

  /// Frees the window of this frame and all before it. False where it is not a frame that was sent and is not
  /// acknowledged yet.
  bool acknowledge(std::uint64_t frameId);

  /// False where too many snapshots are under way already.
  bool admitSnapshot(std::uint64_t sequence);

  /// Drops everything that waits and gives the writer `reason` as its last item. Only the first reason counts.
  void close(CloseReason reason);
  bool closed() const;

  /// What to send next: replies and latest-wins messages in the order of their coming, a newer message in the place of
  /// the one that it replaces, so that a reply tells that what was said before it has gone out; frames after them.
  /// None: the writer is to wait, and the next push that says Sent (or Overflow, or a close) is to wake it.
  std::optional<Item> next();

 private:
  static constexpr std::size_t kLatestKinds = 2;

  struct Reply {
    WireMessage message;
    std::uint64_t inReplyTo = 0;
    std::uint64_t order = 0;
  };
  struct LatestMessage {
    WireMessage message;  ///< Null: none waits.
    std::uint64_t order = 0;
  };
  struct QueuedFrame {
    std::uint64_t id = 0;
    WireMessage message;
  };

  SendResult queued();
  void closeLocked(CloseReason reason);
  std::optional<Item> takeLocked();
  WireMessage takeReply();
  LatestMessage* firstLatest();

  const Limits limits_;
  mutable std::mutex mutex_;
  std::deque<Reply> replies_;
  std::size_t replyBytes_ = 0;
  std::array<LatestMessage, kLatestKinds> latest_;
  std::uint64_t pushes_ = 0;
  std::deque<QueuedFrame> frames_;
  std::deque<std::uint64_t> unacknowledged_;  // Ids of the frames handed to the writer, oldest first.
  std::vector<std::uint64_t> snapshots_;      // Sequence numbers of those under way.
  bool held_ = false;
  bool writerWaits_ = false;
  std::optional<CloseReason> closing_;
  bool closeTaken_ = false;
};

}  // namespace sluice::stream
