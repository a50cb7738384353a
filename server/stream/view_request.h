#pragma once

#include <optional>
#include <span>
#include <string>

#include "sluice/core/camera.h"
#include "sluice/stream/backend.h"
#include "sluice/v1/session.pb.h"

namespace sluice::stream {

// What a viewer asks for, checked. Every function throws core::InputError, which names the field, for what it cannot
// take.

/// The sizes lie within 1 and the limits; `message` stands before "width" and "height" in the field path.
core::ImageSize checkedSize(std::uint32_t width, std::uint32_t height, const v1::Limits& limits,
                            const std::string& message);

/// `codecs` are those that the server offers.
View checkedView(const v1::SetView& request, const v1::Limits& limits, std::span<const v1::Codec> codecs);

/// Finite, of a direction, and within bounds that keep a run stable.
void checkInteract(const v1::Interact& request);

PickPoint checkedPick(const v1::Pick& request);

/// Missing fields take the defaults of the schema.
core::Camera checkedCamera(v1::Camera camera);

}  // namespace sluice::stream
