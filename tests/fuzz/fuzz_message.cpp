// The bytes of one message from a viewer that has said Hello.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "conversation.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sluice::stream::test::Conversation talk;
  talk.hello();
  talk.protocol.onMessage({reinterpret_cast<const char*>(data), size});
  talk.sent();
  talk.protocol.onEnd();
  return 0;
}
