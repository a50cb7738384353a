#pragma once

#include <google/protobuf/util/message_differencer.h>

namespace sluice::render {

/// Whether two messages of one type say the same.
template <class Message>
bool same(const Message& a, const Message& b) {
  return google::protobuf::util::MessageDifferencer::Equals(a, b);
}

}  // namespace sluice::render
