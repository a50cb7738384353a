#pragma once

#include "sluice/client/option_values.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::client {

/// The direction, of length 1, in which a camera sees a point of a picture of this size, by the server's conventions:
/// another axis where `up` is along the view, -z where eye and target coincide.
v1::Vec3 lineOfSight(const v1::Camera& camera, const PictureSize& size, const PicturePoint& point);

}  // namespace sluice::client
