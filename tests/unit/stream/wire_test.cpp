#include "wire.h"

#include <gtest/gtest.h>

namespace sluice::stream::test {
namespace {

core::EncodedFrame frameOf(std::size_t payloadBytes) {
  core::EncodedFrame frame;
  frame.tag = {.viewer = 9,
               .frameId = 1234567890123,
               .reflectsSequence = 77,
               .snapshotSequence = 55,
               .simulationTime = 1.25,
               .inReplyTo = 0,
               .stages = {{"splats", 3.5}, {"encode", 0.25}}};
  frame.size = {1280, 720};
  frame.codec = core::Codec::Jpeg;
  for (std::size_t i = 0; i < payloadBytes; ++i) frame.bytes.push_back(static_cast<std::uint8_t>(i * 31U));
  return frame;
}

// The sizes cross the lengths at which the varints before the payload grow.
TEST(Wire, FrameReadsBackWithEveryField) {
  for (const std::size_t bytes : {0UL, 1UL, 60UL, 127UL, 128UL, 16'383UL, 16'384UL, 2'097'152UL}) {
    const core::EncodedFrame frame = frameOf(bytes);
    v1::ServerMessage message;
    ASSERT_TRUE(message.ParseFromString(*toWire(frame))) << bytes;
    EXPECT_EQ(message.in_reply_to(), 0U);
    const v1::Frame& read = message.frame();
    EXPECT_EQ(read.frame_id(), 1234567890123U);
    EXPECT_EQ(read.codec(), v1::JPEG);
    EXPECT_EQ(read.width(), 1280U);
    EXPECT_EQ(read.height(), 720U);
    EXPECT_TRUE(read.keyframe());
    EXPECT_EQ(read.reflects_sequence(), 77U);
    EXPECT_EQ(read.simulation_time(), 1.25);
    EXPECT_EQ(read.snapshot_sequence(), 55U);
    EXPECT_FALSE(read.snapshot());
    ASSERT_EQ(read.stages_size(), 2);
    EXPECT_EQ(read.stages(0).name(), "splats");
    EXPECT_EQ(read.stages(1).milliseconds(), 0.25);
    EXPECT_EQ(std::vector<std::uint8_t>(read.payload().begin(), read.payload().end()), frame.bytes);
  }
}

TEST(Wire, SnapshotAnswersItsRequest) {
  core::EncodedFrame frame = frameOf(10);
  frame.tag.inReplyTo = 300;
  frame.codec = core::Codec::Png;
  v1::ServerMessage message;
  ASSERT_TRUE(message.ParseFromString(*toWire(frame)));
  EXPECT_EQ(message.in_reply_to(), 300U);
  EXPECT_TRUE(message.frame().snapshot());
  EXPECT_EQ(message.frame().codec(), v1::PNG);
}

}  // namespace
}  // namespace sluice::stream::test
