#include "run_client.h"

#include <sstream>
#include <utility>

#include "sluice/client/command_line.h"

namespace sluice::client {

Json Outcome::json() const {
  const std::string lines = out.substr(0, out.find_last_not_of('\n') + 1);
  return Json::parse(lines.substr(lines.rfind('\n') + 1));
}

Outcome run(std::vector<std::string> arguments, bool terminal) {
  std::ostringstream out;
  std::ostringstream err;
  const int exitCode = runCommandLine(arguments, {out, err, terminal});
  return {exitCode, out.str(), err.str()};
}

Outcome run(const FakeServer& server, std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--server", server.url().text(), "--timeout", "20"});
  return run(std::move(arguments));
}

Reaction refuse(const v1::ClientMessage& message) {
  if (message.has_hello()) return oblige(message);
  v1::ServerMessage reply = replyTo(message);
  reply.mutable_error()->set_field_path("look.smoothing.time");
  reply.mutable_error()->set_message("99 is outside [0, 50] d²");
  return {.messages = {reply}};
}

}  // namespace sluice::client
