#include "view_request.h"

#include <gtest/gtest.h>

#include <limits>

#include "conversation.h"

namespace sluice::stream::test {
namespace {

v1::ClientMessage viewOf(std::uint32_t width, std::uint32_t height) {
  v1::ClientMessage message;
  message.mutable_set_view()->set_width(width);
  message.mutable_set_view()->set_height(height);
  return message;
}

struct SetViewTest : testing::Test {
  SetViewTest() { talk.hello(); }

  // The field that is named when this is refused; the backend must not hear of it.
  std::string refusedField(const v1::ClientMessage& message) {
    const v1::Error error = talk.refused(message);
    EXPECT_EQ(error.code(), v1::Error::INVALID);
    EXPECT_FALSE(talk.backend.view);
    return error.field_path();
  }

  Conversation talk;
};

TEST_F(SetViewTest, DefaultsFillWhatTheViewerLeavesOpen) {
  EXPECT_TRUE(talk.say(viewOf(640, 480)).empty());
  ASSERT_TRUE(talk.backend.view);
  EXPECT_EQ(talk.backend.view->size, (core::ImageSize{640, 480}));
  EXPECT_EQ(talk.backend.view->codecs.front(), core::Codec::Jpeg);
  EXPECT_EQ(talk.backend.view->quality, 85);
  EXPECT_EQ(talk.backend.view->maxRate, 60);
}

TEST_F(SetViewTest, SizeLiesWithinTheLimits) {
  EXPECT_EQ(refusedField(viewOf(0, 480)), "set_view.width");
  EXPECT_EQ(refusedField(viewOf(1921, 480)), "set_view.width");
  EXPECT_EQ(refusedField(viewOf(640, 0)), "set_view.height");
  EXPECT_EQ(refusedField(viewOf(640, 4000000000U)), "set_view.height");
  EXPECT_TRUE(talk.say(viewOf(1920, 1080)).empty());
  EXPECT_TRUE(talk.say(viewOf(1, 1)).empty());
}

TEST_F(SetViewTest, RefusalTellsTheValueAndWhatIsAllowed) {
  EXPECT_EQ(talk.refused(viewOf(640, 2000)).message(), "2000 is outside [1, 1080] pixels");
}

TEST_F(SetViewTest, TakesTheFirstCodecThatBothKnow) {
  v1::ClientMessage message = viewOf(640, 480);
  message.mutable_set_view()->add_codecs(static_cast<v1::Codec>(77));
  message.mutable_set_view()->add_codecs(v1::PNG);
  message.mutable_set_view()->add_codecs(v1::JPEG);
  EXPECT_TRUE(talk.say(message).empty());
  EXPECT_EQ(talk.backend.view->codecs.front(), core::Codec::Png);
}

TEST_F(SetViewTest, NoCommonCodecIsInvalid) {
  v1::ClientMessage message = viewOf(640, 480);
  message.mutable_set_view()->add_codecs(static_cast<v1::Codec>(77));
  message.mutable_set_view()->add_codecs(v1::CODEC_UNSPECIFIED);
  const v1::Error error = talk.refused(message);
  EXPECT_EQ(error.field_path(), "set_view.codecs");
  EXPECT_EQ(error.message(), "none of them is known here; allowed are JPEG, PNG");
}

TEST_F(SetViewTest, QualityAndRateLieWithinTheirRanges) {
  v1::ClientMessage message = viewOf(640, 480);
  message.mutable_set_view()->set_quality(101);
  EXPECT_EQ(refusedField(message), "set_view.quality");
  message.mutable_set_view()->set_quality(100);
  for (const double rate : {-1.0, 60.5, std::numeric_limits<double>::quiet_NaN()}) {
    message.mutable_set_view()->set_max_rate(rate);
    EXPECT_EQ(refusedField(message), "set_view.max_rate");
  }
  message.mutable_set_view()->set_max_rate(0.5);
  EXPECT_TRUE(talk.say(message).empty());
  EXPECT_EQ(talk.backend.view->quality, 100);
  EXPECT_EQ(talk.backend.view->maxRate, 0.5);
}

TEST_F(SetViewTest, CameraTakesTheDefaultsOfTheSchema) {
  v1::ClientMessage message;
  message.mutable_set_camera()->mutable_camera()->mutable_eye()->set_x(9);
  EXPECT_TRUE(talk.say(message).empty());
  ASSERT_TRUE(talk.backend.camera);
  EXPECT_EQ(talk.backend.camera->eye.x(), 9.0F);
  EXPECT_EQ(talk.backend.camera->up, core::Camera{}.up);
  EXPECT_EQ(talk.backend.camera->verticalFovDegrees, 45.0F);
}

TEST_F(SetViewTest, CameraOutOfRangeIsNamedByItsPath) {
  for (const double value : {1e6, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    v1::ClientMessage message;
    message.mutable_set_camera()->mutable_camera()->mutable_target()->set_z(value);
    const v1::Error error = talk.refused(message);
    EXPECT_EQ(error.code(), v1::Error::INVALID);
    EXPECT_EQ(error.field_path().substr(0, 13), "camera.target") << error.field_path();
    EXPECT_FALSE(talk.backend.camera);
  }
}

TEST_F(SetViewTest, SnapshotIsCheckedLikeAView) {
  v1::ClientMessage message;
  message.mutable_snapshot()->set_width(640);
  EXPECT_EQ(talk.refused(message).field_path(), "snapshot.height");
  message.mutable_snapshot()->set_height(480);
  message.mutable_snapshot()->mutable_camera()->set_vertical_fov_degrees(0);
  EXPECT_EQ(talk.refused(message).field_path(), "camera.vertical_fov_degrees");
  EXPECT_TRUE(talk.backend.calls.empty());
}

}  // namespace
}  // namespace sluice::stream::test
