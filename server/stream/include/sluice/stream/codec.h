#pragma once

#include <optional>

#include "sluice/core/frame.h"
#include "sluice/v1/session.pb.h"

namespace sluice::stream {

v1::Codec toProto(core::Codec codec);

/// None for a codec that this server does not have.
std::optional<core::Codec> fromProto(v1::Codec codec);

}  // namespace sluice::stream
