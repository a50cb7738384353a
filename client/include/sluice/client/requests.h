#pragma once

#include <functional>
#include <string>

#include "sluice/client/connection.h"
#include "sluice/v1/session.pb.h"

namespace sluice::client {

/// "look.smoothing.time: 99 is outside [0, 50] d²": the field path, where the server names one, and its words.
std::string describe(const v1::Error& error);

/// Sends a message and returns the server's answer to it, a Done, a Picked or a snapshot's Frame. What comes in between
/// goes to `other`. Throws RequestError with the server's words for an Error, and when no answer comes in the
/// connection's time; ConnectionError as Connection does.
v1::ServerMessage request(Connection& connection, v1::ClientMessage message,
                          const std::function<void(const v1::ServerMessage&)>& other = {});

/// The same, for an answer that may take another time than the connection's.
v1::ServerMessage request(Connection& connection, v1::ClientMessage message, Connection::Clock::time_point deadline,
                          const std::function<void(const v1::ServerMessage&)>& other = {});

/// The state that the server told last: takes in everything that it sent before it saw this call, by a Ping and its
/// Pong. The server tells its state after each change of it, but promises no order with the change's Done.
v1::Stats currentStats(Connection& connection);

}  // namespace sluice::client
