#include "sluice/gl/objects.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "sluice/gl/context.h"
#include "sluice/gl/debug_messages.h"
#include "sluice/gl/pass_clock.h"
#include "sluice/gl/shader_library.h"

namespace sluice::gl {
namespace {

class GlTest : public ::testing::Test {
 protected:
  std::unique_ptr<Context> context = Context::create(DebugOutput::On);
  DebugMessages messages;
};

TEST_F(GlTest, ContextNamesItsRenderer) { EXPECT_FALSE(context->rendererName().empty()); }

TEST_F(GlTest, MovedFromIsZero) {
  Texture first = makeTexture(GL_R32F, {4, 4});
  const GLuint name = first.name();
  ASSERT_NE(name, 0U);
  Texture second(std::move(first));
  EXPECT_EQ(first.name(), 0U);
  EXPECT_EQ(second.name(), name);
  Texture third;
  third = std::move(second);
  EXPECT_EQ(second.name(), 0U);
  EXPECT_EQ(third.name(), name);
}

TEST_F(GlTest, DestroyedObjectsAreDeleted) {
  GLuint name = 0;
  {
    const Texture texture = makeTexture(GL_R32F, {4, 4});
    name = texture.name();
    EXPECT_TRUE(glIsTexture(name));
  }
  EXPECT_FALSE(glIsTexture(name));
}

TEST_F(GlTest, ErrorsAreReported) {
  glEnable(GL_TEXTURE_2D + 12345);
  EXPECT_EQ(messages.take().size(), 1U);
  EXPECT_TRUE(messages.take().empty());
}

TEST_F(GlTest, ShaderErrorsNameFileAndLine) {
  const ShaderLibrary library({{"a.vert", "void main() { gl_Position = vec4(0.0); }\n"},
                               {"a.frag", "#include \"b.glsl\"\nout vec4 c;\nvoid main() { c = half(1.0); }\n"},
                               {"b.glsl", "\n\nvec4 half(float x) { return vec4(x * nothing); }\n"}});
  try {
    library.program("a.vert", "a.frag");
    FAIL() << "it compiled";
  } catch (const ShaderError& error) {
    EXPECT_NE(std::string(error.what()).find("b.glsl:3"), std::string::npos) << error.what();
  }
}

TEST_F(GlTest, StreamBufferGrowsAndKeepsItsSize) {
  StreamBuffer buffer;
  const std::vector<std::byte> many(1000);
  buffer.upload(many);
  EXPECT_EQ(buffer.capacity(), 1000U);
  buffer.upload(std::span(many).first(10));
  EXPECT_EQ(buffer.capacity(), 1000U);
  buffer.upload({});
  EXPECT_TRUE(messages.take().empty());
}

TEST_F(GlTest, ClockNamesEveryLap) {
  PassClock clock(context->isSoftware());
  clock.start();
  clock.lap("a");
  clock.lap("b");
  clock.lap("a");
  const core::StageTimes times = clock.finish();
  ASSERT_EQ(times.size(), 2U);
  EXPECT_EQ(times[0].name, "a");
  EXPECT_EQ(times[1].name, "b");
  EXPECT_GE(times[0].milliseconds, 0.0);
}

}  // namespace
}  // namespace sluice::gl
