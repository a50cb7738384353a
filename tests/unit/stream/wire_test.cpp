#include "wire.h"

#include <gtest/gtest.h>

namespace sluice::stream::test {
namespace {

const core::Delivery kDelivery{
    .viewer = 9, .frameId = 1234567890123, .reflectsSequence = 77, .inReplyTo = 0, .askedAt = {}};

core::EncodedFrame frameOf(std::size_t payloadBytes) {
  core::EncodedFrame frame;
  frame.tag = {
      .snapshotSequence = 55, .simulationTime = 1.25, .still = true, .stages = {{"splats", 3.5}, {"encode", 0.25}}};
  frame.size = {1280, 720};
  frame.codec = core::Codec::Jpeg;
  frame.quality = 70;
  for (std::size_t i = 0; i < payloadBytes; ++i) frame.bytes.push_back(static_cast<std::uint8_t>(i * 31U));
  return frame;
}

// The sizes cross the lengths at which the varints before the payload grow.
TEST(Wire, FrameReadsBackWithEveryField) {
  for (const std::size_t bytes : {0UL, 1UL, 60UL, 127UL, 128UL, 16'383UL, 16'384UL, 2'097'152UL}) {
    const core::EncodedFrame frame = frameOf(bytes);
    v1::ServerMessage message;
    ASSERT_TRUE(message.ParseFromString(*toWire(frame, kDelivery))) << bytes;
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
    EXPECT_TRUE(read.still());
    EXPECT_EQ(read.quality(), 70U);
    EXPECT_EQ(read.response_milliseconds(), 0) << "an earlier frame answered already";
    ASSERT_EQ(read.stages_size(), 2);
    EXPECT_EQ(read.stages(0).name(), "splats");
    EXPECT_EQ(read.stages(1).milliseconds(), 0.25);
    EXPECT_EQ(std::vector<std::uint8_t>(read.payload().begin(), read.payload().end()), frame.bytes);
  }
}

TEST(Wire, SnapshotAnswersItsRequest) {
  core::EncodedFrame frame = frameOf(10);
  frame.codec = core::Codec::Png;
  v1::ServerMessage message;
  ASSERT_TRUE(message.ParseFromString(
      *toWire(frame, {.viewer = 9, .frameId = 0, .reflectsSequence = 0, .inReplyTo = 300, .askedAt = {}})));
  EXPECT_EQ(message.in_reply_to(), 300U);
  EXPECT_TRUE(message.frame().snapshot());
  EXPECT_EQ(message.frame().codec(), v1::PNG);
}

TEST(Wire, TellsHowLongTheAnswerTook) {
  core::Delivery delivery = kDelivery;
  delivery.askedAt = std::chrono::steady_clock::now() - std::chrono::milliseconds(50);
  v1::ServerMessage message;
  ASSERT_TRUE(message.ParseFromString(*toWire(frameOf(10), delivery)));
  EXPECT_GE(message.frame().response_milliseconds(), 50);
}

TEST(Wire, VideoSaysHowItIsDecoded) {
  core::EncodedFrame frame = frameOf(10);
  frame.codec = core::Codec::H264;
  frame.keyframe = false;
  frame.decoder = "avc1.42C01F";
  v1::ServerMessage message;
  ASSERT_TRUE(message.ParseFromString(*toWire(frame, kDelivery)));
  EXPECT_EQ(message.frame().codec(), v1::H264);
  EXPECT_FALSE(message.frame().keyframe());
  EXPECT_EQ(message.frame().decoder(), "avc1.42C01F");
  EXPECT_EQ(message.frame().matrix(), v1::BT709);
}

}  // namespace
}  // namespace sluice::stream::test
