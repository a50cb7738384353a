#pragma once

#include <span>
#include <string>

#include "sluice/v1/session.pb.h"

namespace sluice::client {

/// The update that makes assignments such as
///   look.smoothing.time=2                    a number, true or false, or plain text
///   camera.eye=1,2,3                         a vector
///   look.smoothing.bilateral={}              a message in text format, which also chooses a member of a oneof
///   simulation.fluids[0].viscosity=0.1       a field of a list's element
///   simulation.fluids[0].blocks=[{...},{...}]  a whole list
/// A later assignment to the same path replaces an earlier one. Throws UsageError for a path that the schema does not
/// have, naming those it has, for a value of the wrong kind, and for two members of one oneof. Ranges are the server's
/// business.
v1::UpdateScene sceneUpdate(std::span<const std::string> assignments);

}  // namespace sluice::client
