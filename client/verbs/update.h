#pragma once

#include "sluice/client/connection.h"
#include "sluice/v1/session.pb.h"

namespace sluice::client {

/// Has the server change the scene; whether that started it again. Throws RequestError where it refuses.
bool applyUpdate(Connection& connection, const v1::UpdateScene& update);

}  // namespace sluice::client
