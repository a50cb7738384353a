#pragma once

#include <cstdint>

namespace sluice::stream {

/// What became of a message for a viewer.
enum class SendResult : std::uint8_t {
  Sent,      ///< Nothing stood before it: it goes out now.
  Queued,    ///< It goes out after what is being sent.
  Replaced,  ///< Queued in the place of an older one of its kind that nobody needs any more.
  Dropped,   ///< A frame beyond the viewer's window: it is not sent.
  Overflow,  ///< The viewer reads too slowly for its queue: nothing is sent, and it is being disconnected.
  Gone,      ///< There is no such viewer (any more).
};

}  // namespace sluice::stream
