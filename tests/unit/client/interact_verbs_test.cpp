// Verbs that reach into the picture, against a fake server: push, pull, add and pick.

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_client.h"

namespace sluice::client {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(Interactions, SendTheLineOfSight) {
  const FakeServer server(oblige);
  const std::string camera = "0,0,2:0,0,0:90";
  const Outcome outcome = run(server, {"push", "1,0.5", "--camera", camera, "--size", "200x100", "--radius", "0.2",
                                       "--strength", "12", "--seconds", "0.5", "--json"});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  const v1::Interact push = server.received().back().interact();
  EXPECT_EQ(push.action(), v1::Interact::PUSH);
  EXPECT_EQ(push.origin().z(), 2);
  // At the right edge tan 45° · 200/100 = 2 to the right for each 1 forwards.
  EXPECT_NEAR(push.direction().x(), 2 / std::sqrt(5.0), 1e-9);
  EXPECT_NEAR(push.direction().y(), 0, 1e-9);
  EXPECT_NEAR(push.direction().z(), -1 / std::sqrt(5.0), 1e-9);
  EXPECT_EQ(push.radius(), 0.2);
  EXPECT_EQ(push.strength(), 12);
  EXPECT_EQ(push.seconds(), 0.5);

  EXPECT_EQ(run(server, {"add", "0.5,0.5", "--fluid", "1"}).exitCode, 0);
  EXPECT_EQ(server.received().back().interact().action(), v1::Interact::ADD);
  EXPECT_EQ(server.received().back().interact().fluid(), 1U);
  EXPECT_EQ(server.received().back().interact().origin().x(), 3) << "the scene's camera";
  EXPECT_EQ(run(server, {"pull", "0.5,0.5"}).exitCode, 0);
  EXPECT_EQ(server.received().back().interact().action(), v1::Interact::PULL);
  EXPECT_EQ(run(FakeServer(refuse), {"pull", "0.5,0.5"}).exitCode, 1);
}

Reaction answerPick(const v1::ClientMessage& message, bool hit) {
  if (!message.has_pick()) return oblige(message);
  v1::ServerMessage reply = replyTo(message);
  v1::Picked& picked = *reply.mutable_picked();
  picked.set_hit(hit);
  picked.mutable_position()->set_y(0.25);
  picked.set_depth(3);
  picked.set_thickness(0.5);
  picked.set_density(1000);
  return {.messages = {reply}};
}

TEST(Pick, TellsWhatIsThere) {
  const FakeServer server([](const v1::ClientMessage& message) { return answerPick(message, true); });
  const Json json = run(server, {"pick", "0.25,0.75", "--size", "320x200", "--json"}).json();
  EXPECT_EQ(json["hit"], true);
  EXPECT_EQ(json["position"], Json({0.0, 0.25, 0.0}));
  EXPECT_EQ(json["depth"], 3);
  EXPECT_EQ(json["thickness"], 0.5);
  EXPECT_EQ(json["density"], 1000);
  const std::vector<v1::ClientMessage> received = server.received();
  EXPECT_EQ(received[1].set_view().width(), 320U) << "the picture that is picked from";
  EXPECT_EQ(received[2].pick().x(), 0.25);
  EXPECT_EQ(received[2].pick().y(), 0.75);
  EXPECT_EQ(received[2].pick().camera().eye().x(), 3);
  EXPECT_THAT(run(server, {"pick", "0.5,0.5"}).out, AllOf(HasSubstr("0, 0.25, 0 m"), HasSubstr("1000 kg")));
}

TEST(Pick, ThereMayBeNothing) {
  const FakeServer server([](const v1::ClientMessage& message) { return answerPick(message, false); });
  const Json json = run(server, {"pick", "0.5,0.5", "--json"}).json();
  EXPECT_EQ(json["hit"], false);
  EXPECT_TRUE(json["position"].is_null());
  EXPECT_EQ(run(server, {"pick", "0.5,0.5"}).out, "no fluid there\n");
}

}  // namespace
}  // namespace sluice::client
