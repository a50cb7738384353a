// Random and mutated messages against a live server: it answers or closes, never hangs, and serves on.
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "live_server.h"

namespace sluice::stream::test {
namespace {

using sluice::test::ConnectionEnded;
using sluice::test::TestViewer;

/// One message of every kind, in range.
std::vector<v1::ClientMessage> everyKind() {
  std::vector<v1::ClientMessage> all(12);
  all[0].mutable_hello()->set_client("mutant");
  all[1].mutable_set_view()->set_width(64);
  all[1].mutable_set_view()->set_height(48);
  all[1].mutable_set_view()->add_codecs(v1::JPEG);
  all[2].mutable_set_camera()->mutable_camera()->mutable_eye()->set_x(3);
  all[3].mutable_update_scene()->mutable_scene()->mutable_look()->mutable_smoothing()->set_time(2);
  all[3].mutable_update_scene()->mutable_mask()->add_paths("look.smoothing.time");
  all[4].mutable_control()->set_action(v1::Control::STEP);
  all[5].mutable_load_scene()->set_text("title: \"x\"");
  all[6].mutable_frame_ack()->set_frame_id(1);
  all[7].mutable_snapshot()->set_width(8);
  all[7].mutable_snapshot()->set_height(8);
  all[8].mutable_ping()->set_client_time(1.5);
  all[9].mutable_keyframe();
  all[10].mutable_interact()->set_action(v1::Interact::PUSH);
  all[10].mutable_interact()->mutable_direction()->set_z(-1);
  all[11].mutable_pick()->set_x(0.5);
  return all;
}

class Mutator {
 public:
  std::string next(std::uint64_t sequence) {
    v1::ClientMessage message = messages_[pick(messages_.size())];
    message.set_sequence(sequence);
    std::string bytes = message.SerializeAsString();
    for (std::size_t changes = pick(4); changes > 0; --changes) mutate(bytes);
    return bytes;
  }

  std::size_t pick(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }

 private:
  void mutate(std::string& bytes) {
    const auto byte = static_cast<char>(pick(256));
    switch (pick(5)) {
      case 0:
        bytes.insert(pick(bytes.size() + 1), 1 + pick(8), byte);
        break;
      case 1:
        bytes.resize(pick(bytes.size() + 1));
        break;
      case 2:
        bytes += bytes.substr(pick(bytes.size() + 1));
        break;
      default:
        if (!bytes.empty()) bytes[pick(bytes.size())] = byte;
    }
  }

  std::mt19937 random_{20240607};
  std::vector<v1::ClientMessage> messages_ = everyKind();
};

TEST(MutatedMessages, TenThousandLeaveTheServerWhole) {
  ServerOptions options;
  options.maxMessageRate = 1e6;
  LiveServer server(options);
  TestViewer witness = server.connect();
  witness.hello();
  witness.setView(64, 48);

  Mutator mutator;
  int connections = 0;
  std::uint64_t sequence = 0;
  std::optional<TestViewer> mutant;
  for (int k = 0; k < 10'000; ++k) {
    try {
      if (!mutant) {
        mutant.emplace(server.connect());
        ++connections;
        sequence = 1;
        // Half of them get past the Hello first.
        if (mutator.pick(2) == 0) mutant->hello();
      }
      mutant->sendBinary(mutator.next(++sequence));
      // What comes back is read now and then, so that the queue of answers stays short.
      if (k % 16 == 0) {
        while (mutant->tryReceive(std::chrono::milliseconds(0))) {
        }
      }
    } catch (const std::runtime_error&) {
      mutant.reset();
    }
    if (k % 500 == 0) witness.nextFrame();
  }
  mutant.reset();
  EXPECT_GT(connections, 10) << "malformed ones close the connection";
  witness.nextFrame();
  EXPECT_TRUE(server.backend.waitForLeft(server.backend.counts().joined - 1)) << "nobody is stuck";
}

}  // namespace
}  // namespace sluice::stream::test
