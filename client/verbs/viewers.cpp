#include <iomanip>
#include <ostream>

#include "sluice/client/failure.h"
#include "sluice/client/json.h"
#include "sluice/client/requests.h"
#include "verbs/verb.h"

namespace sluice::client {

namespace {

/// The server tells who is there when someone comes, so also when this viewer does.
v1::ViewersChanged currentViewers(Connection& connection) {
  const auto deadline = Connection::Clock::now() + connection.timeout();
  while (const std::optional<v1::ServerMessage> message = connection.receive(deadline)) {
    if (message->has_viewers_changed()) return message->viewers_changed();
  }
  throw RequestError("the server does not tell who looks on");
}

std::string roleName(v1::Role role) { return role == v1::SPECTATOR ? "spectator" : "driver"; }

std::string sizeText(const v1::ViewersChanged::Viewer& viewer) {
  return viewer.width() == 0 ? "-" : std::to_string(viewer.width()) + "x" + std::to_string(viewer.height());
}

void printJson(std::ostream& out, const v1::ViewersChanged& present, std::uint64_t self) {
  Json viewers = Json::array();
  for (const v1::ViewersChanged::Viewer& viewer : present.viewers()) {
    viewers.push_back({{"viewer_id", viewer.viewer_id()},
                       {"client", viewer.client()},
                       {"role", roleName(viewer.role())},
                       {"width", viewer.width()},
                       {"height", viewer.height()},
                       {"follows", viewer.follows() == 0 ? Json() : Json(viewer.follows())},
                       {"self", viewer.viewer_id() == self}});
  }
  out << toLine({{"viewers", viewers}});
}

void printTable(std::ostream& out, const v1::ViewersChanged& present, std::uint64_t self) {
  out << "  viewer  role       size       follows  client\n";
  for (const v1::ViewersChanged::Viewer& viewer : present.viewers()) {
    out << (viewer.viewer_id() == self ? "* " : "  ") << std::left << std::setw(8) << viewer.viewer_id()
        << std::setw(11) << roleName(viewer.role()) << std::setw(11) << sizeText(viewer) << std::setw(9)
        << (viewer.follows() == 0 ? "-" : std::to_string(viewer.follows())) << viewer.client() << '\n';
  }
}

void viewers(const Context& context) {
  Connection connection = context.connect();
  const v1::ViewersChanged present = currentViewers(connection);
  (context.json ? printJson : printTable)(context.output.out, present, connection.welcome().viewer_id());
}

}  // namespace

void addViewers(CLI::App& app, Action& chosen) {
  app.add_subcommand("viewers", "Who looks on, with which picture; * marks this program")->callback([&chosen] {
    chosen = viewers;
  });
}

}  // namespace sluice::client
