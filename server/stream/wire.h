#pragma once

#include "outbox.h"
#include "sluice/core/frame.h"
#include "sluice/v1/session.pb.h"

namespace sluice::stream {

WireMessage toWire(const v1::ServerMessage& message);

/// A ServerMessage with a Frame. The encoded picture is copied once, straight into the message: protobuf's own way
/// would copy it into the Frame first.
WireMessage toWire(const core::EncodedFrame& frame, const core::Delivery& delivery);

}  // namespace sluice::stream
