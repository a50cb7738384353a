// A whole conversation: each input is a run of messages, every one behind its length in two bytes; between them frames
// and broadcasts of the server, and at last the end. Whatever is said, a viewer joins at most once and leaves as often.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "conversation.h"

namespace {

using namespace sluice;

std::size_t count(const stream::test::RecordingBackend& backend, const std::string& call) {
  return static_cast<std::size_t>(std::count(backend.calls.begin(), backend.calls.end(), call));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  stream::test::Conversation talk;
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  std::uint64_t frame = 0;
  while (rest.size() >= 2 && !talk.outbox.closed()) {
    const auto low = static_cast<std::uint8_t>(rest[0]);
    const auto high = static_cast<std::uint8_t>(rest[1]);
    const std::size_t length = std::min<std::size_t>(low + 256U * (high & 0x1fU), rest.size() - 2);
    if (const auto reason = talk.protocol.onMessage(rest.substr(2, length))) talk.outbox.close(*reason);
    if ((high & 0x20U) != 0) talk.outbox.pushFrame(++frame, std::make_shared<const std::string>("frame"));
    if ((high & 0x40U) != 0) {
      talk.outbox.pushLatest(stream::Outbox::Latest::Stats, std::make_shared<const std::string>("stats"));
    }
    if ((high & 0x80U) != 0) talk.sent();
    rest.remove_prefix(2 + length);
  }
  talk.protocol.onEnd();
  talk.protocol.onEnd();
  const std::size_t joined = count(talk.backend, "join 5");
  if (joined > 1 || count(talk.backend, "leave 5") != joined) std::abort();
  return 0;
}
