#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "close_reason.h"
#include "outbox.h"
#include "sluice/stream/access.h"
#include "sluice/stream/backend.h"
#include "sluice/v1/session.pb.h"

namespace sluice::stream {

/// What one viewer may say and what it is answered: the protocol of session.proto as a state machine without I/O.
/// Valid requests go to the Backend, answers to the Outbox. Not thread-safe, except for `joined`.
class SessionProtocol {
 public:
  /// `backend` and `outbox` must outlive the protocol.
  /// `shownToken` is what the handshake carried; the Hello may show another. `access` must outlive the protocol too.
  SessionProtocol(core::ViewerId viewer, const v1::Limits& limits, const Access& access, std::string shownToken,
                  Backend& backend, Outbox& outbox);

  /// Takes the bytes of one binary WebSocket message. A reason says that the connection is to be closed with it.
  std::optional<CloseReason> onMessage(std::string_view bytes);

  /// Takes a text message, which has no place in the protocol.
  CloseReason onText() const;

  /// The connection has ended: the viewer leaves the backend, if it ever joined. Idempotent.
  void onEnd();

  /// Hello was said, and the viewer has not left: it takes part in broadcasts. Thread-safe.
  bool joined() const { return joined_.load(std::memory_order_acquire); }

  /// What the viewer called itself in its Hello.
  const std::string& client() const { return client_; }

 private:
  void dispatch(const v1::ClientMessage& message);
  void hello(std::uint64_t sequence, const v1::Hello& hello);
  void setView(std::uint64_t sequence, const v1::SetView& request);
  void setCamera(std::uint64_t sequence, const v1::SetCamera& request);
  void updateScene(std::uint64_t sequence, const v1::UpdateScene& request);
  void control(std::uint64_t sequence, const v1::Control& request);
  void loadScene(std::uint64_t sequence, const v1::LoadScene& request);
  void acknowledge(const v1::FrameAck& ack);
  void interact(std::uint64_t sequence, const v1::Interact& request);
  void pick(std::uint64_t sequence, const v1::Pick& request);
  void snapshot(std::uint64_t sequence, const v1::SnapshotRequest& request);
  void pong(std::uint64_t sequence, const v1::Ping& ping);

  void requireDriver() const;
  void reply(std::uint64_t sequence, v1::ServerMessage message);
  void replyError(std::uint64_t sequence, v1::Error::Code code, const std::string& fieldPath,
                  const std::string& problem);

  const core::ViewerId viewer_;
  const v1::Limits limits_;
  const Access& access_;
  const std::string shownToken_;
  Backend& backend_;
  Outbox& outbox_;
  std::vector<v1::Codec> codecs_;  // Those of the Welcome.
  std::string client_;
  v1::Role role_ = v1::SPECTATOR;
  std::uint64_t lastSequence_ = 0;
  std::atomic<bool> joined_ = false;
};

}  // namespace sluice::stream
