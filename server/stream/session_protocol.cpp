#include "session_protocol.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "sluice/core/input_error.h"
#include "view_request.h"
#include "wire.h"

namespace sluice::stream {

namespace {

// A request that is well-formed but does not come at the right time; becomes an Error REFUSED.
struct Refusal {
  std::string problem;
};

// A viewer that may not be here; the connection is closed.
struct Intruder {};

// Bytes of Hello.client that are kept, for the log.
constexpr std::size_t kMaxClientName = 100;

// Without what would let a name forge lines of a log or control a terminal.
std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return text;
}

}  // namespace

SessionProtocol::SessionProtocol(core::ViewerId viewer, const v1::Limits& limits, const Access& access,
                                 std::string shownToken, Backend& backend, Outbox& outbox)
    : viewer_(viewer),
      limits_(limits),
      access_(access),
      shownToken_(std::move(shownToken)),
      backend_(backend),
      outbox_(outbox) {}

std::optional<CloseReason> SessionProtocol::onMessage(std::string_view bytes) {
  v1::ClientMessage message;
  if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
    return CloseReason{CloseCode::InvalidPayload, "not a sluice.v1.ClientMessage"};
  }

  const std::uint64_t sequence = message.sequence();
  try {
    if (sequence <= lastSequence_) {
      throw core::InputError(
          "", "sequence", std::to_string(sequence) + " does not rise; the last was " + std::to_string(lastSequence_));
    }
    lastSequence_ = sequence;
    dispatch(message);
  } catch (const Intruder&) {
    return CloseReason{CloseCode::PolicyViolation, "the token is missing or wrong"};
  } catch (const Refusal& refusal) {
    replyError(sequence, v1::Error::REFUSED, "", refusal.problem);
  } catch (const core::InputError& error) {
    replyError(sequence, v1::Error::INVALID, error.fieldPath(),
               error.where().empty() ? error.problem() : error.where() + ": " + error.problem());
  } catch (const std::exception& error) {
    replyError(sequence, v1::Error::FAILED, "", error.what());
  }
  return std::nullopt;
}

CloseReason SessionProtocol::onText() const {
  return {CloseCode::UnsupportedData, "messages are binary, each one sluice.v1.ClientMessage"};
}

void SessionProtocol::onEnd() {
  if (joined_.exchange(false, std::memory_order_acq_rel)) backend_.leave(viewer_);
}

void SessionProtocol::dispatch(const v1::ClientMessage& message) {
  const std::uint64_t sequence = message.sequence();
  using Case = v1::ClientMessage::MessageCase;
  const Case kind = message.message_case();
  if (!joined() && kind != Case::kHello) throw Refusal{"the first message must be Hello"};

  switch (kind) {
    case Case::kHello:
      return hello(sequence, message.hello());
    case Case::kSetView:
      return setView(sequence, message.set_view());
    case Case::kSetCamera:
      return setCamera(sequence, message.set_camera());
    case Case::kUpdateScene:
      return updateScene(sequence, message.update_scene());
    case Case::kControl:
      return control(sequence, message.control());
    case Case::kLoadScene:
      return loadScene(sequence, message.load_scene());
    case Case::kFrameAck:
      return acknowledge(message.frame_ack());
    case Case::kSnapshot:
      return snapshot(sequence, message.snapshot());
    case Case::kKeyframe:
      return backend_.requestKeyframe(viewer_);
    case Case::kInteract:
      return interact(sequence, message.interact());
    case Case::kPick:
      return pick(sequence, message.pick());
    case Case::kPing:
      return pong(sequence, message.ping());
    case Case::MESSAGE_NOT_SET:
      break;
  }
  // Either nothing was set, or something of a later version, which lands among the unknown fields.
  replyError(sequence, v1::Error::UNSUPPORTED, "", "this server does not know that message");
}

void SessionProtocol::hello(std::uint64_t sequence, const v1::Hello& hello) {
  if (joined()) throw Refusal{"Hello was said before"};
  const std::optional<v1::Role> role =
      access_.roleFor(hello.token().empty() ? shownToken_ : hello.token(), hello.role());
  if (!role) throw Intruder{};
  role_ = *role;
  client_ = printable(hello.client().substr(0, kMaxClientName));

  // From here on the viewer takes part in broadcasts, so that no change of the scene falls between the Welcome, which
  // shows the scene as it is now, and the join; `hold` keeps them behind the Welcome.
  outbox_.hold();
  joined_.store(true, std::memory_order_release);
  try {
    v1::Welcome welcome = backend_.welcome();
    welcome.set_viewer_id(viewer_);
    welcome.set_role(role_);
    *welcome.mutable_limits() = limits_;
    codecs_.clear();
    for (const int codec : welcome.codecs()) codecs_.push_back(static_cast<v1::Codec>(codec));
    v1::ServerMessage answer;
    answer.set_in_reply_to(sequence);
    *answer.mutable_welcome() = std::move(welcome);
    outbox_.release(toWire(answer));
  } catch (...) {
    joined_.store(false, std::memory_order_release);
    outbox_.release(nullptr);
    throw;
  }
  backend_.join(viewer_, {client_, role_});
}

void SessionProtocol::setView(std::uint64_t sequence, const v1::SetView& request) {
  View view = checkedView(request, limits_, codecs_);
  if (view.follow == viewer_) throw core::InputError("", "set_view.follow", "is this viewer itself");
  backend_.setView(viewer_, sequence, view);
}

void SessionProtocol::setCamera(std::uint64_t sequence, const v1::SetCamera& request) {
  if (!request.has_camera()) throw core::InputError("", "camera", "is missing");
  backend_.setCamera(viewer_, sequence, checkedCamera(request.camera()));
}

void SessionProtocol::requireDriver() const {
  if (role_ != v1::DRIVER) throw Refusal{"spectators cannot change the scene"};
}

void SessionProtocol::updateScene(std::uint64_t sequence, const v1::UpdateScene& request) {
  requireDriver();
  if (request.mask().paths().empty()) throw core::InputError("", "mask", "names no field");
  backend_.updateScene(viewer_, sequence, request);
}

void SessionProtocol::control(std::uint64_t sequence, const v1::Control& request) {
  requireDriver();
  if (request.action() == v1::Control::ACTION_UNSPECIFIED || !v1::Control::Action_IsValid(request.action())) {
    throw core::InputError("", "control.action",
                           std::to_string(request.action()) + " is none of PLAY, PAUSE, STEP, RESET");
  }
  if (!std::isfinite(request.until_seconds())) {
    throw core::InputError("", "control.until_seconds", "is no finite number");
  }
  backend_.control(viewer_, sequence, request);
}

void SessionProtocol::loadScene(std::uint64_t sequence, const v1::LoadScene& request) {
  requireDriver();
  if (request.scene_case() == v1::LoadScene::SCENE_NOT_SET) {
    throw core::InputError("", "load_scene", "needs a name or a text");
  }
  backend_.loadScene(viewer_, sequence, request);
}

void SessionProtocol::acknowledge(const v1::FrameAck& ack) {
  if (!outbox_.acknowledge(ack.frame_id())) {
    throw core::InputError("", "frame_ack.frame_id",
                           std::to_string(ack.frame_id()) + " is not a frame that waits for its acknowledgement");
  }
  backend_.acknowledge(viewer_, ack.frame_id());
}

void SessionProtocol::snapshot(std::uint64_t sequence, const v1::SnapshotRequest& request) {
  const core::ImageSize size = checkedSize(request.width(), request.height(), limits_, "snapshot");
  std::optional<core::Camera> camera;
  if (request.has_camera()) camera = checkedCamera(request.camera());
  if (!outbox_.admitSnapshot(sequence)) throw Refusal{"too many snapshots are under way"};
  // Should the backend refuse, the Error that answers this sequence number settles the snapshot too.
  backend_.snapshot(viewer_, sequence, size, camera);
}

void SessionProtocol::interact(std::uint64_t sequence, const v1::Interact& request) {
  requireDriver();
  checkInteract(request);
  backend_.interact(viewer_, sequence, request);
}

void SessionProtocol::pick(std::uint64_t sequence, const v1::Pick& request) {
  backend_.pick(viewer_, sequence, checkedPick(request));
}

void SessionProtocol::pong(std::uint64_t sequence, const v1::Ping& ping) {
  v1::ServerMessage answer;
  answer.mutable_pong()->set_client_time(ping.client_time());
  reply(sequence, std::move(answer));
}

void SessionProtocol::reply(std::uint64_t sequence, v1::ServerMessage message) {
  message.set_in_reply_to(sequence);
  // An overflow closes the outbox, which the writer notices.
  outbox_.pushReply(toWire(message), sequence);
}

void SessionProtocol::replyError(std::uint64_t sequence, v1::Error::Code code, const std::string& fieldPath,
                                 const std::string& problem) {
  v1::ServerMessage message;
  v1::Error& error = *message.mutable_error();
  error.set_code(code);
  error.set_field_path(fieldPath);
  error.set_message(problem);
  reply(sequence, std::move(message));
}

}  // namespace sluice::stream
