#include "sluice/client/option_values.h"

#include <gtest/gtest.h>

#include "sluice/client/failure.h"
#include "sluice/client/server_url.h"

namespace sluice::client {
namespace {

TEST(ServerUrl, FillsInWhatIsLeftOut) {
  EXPECT_EQ(parseServerUrl("ws://127.0.0.1:8081"), (ServerUrl{"127.0.0.1", 8081, "/stream"}));
  EXPECT_EQ(parseServerUrl("ws://host"), (ServerUrl{"host", 8080, "/stream"}));
  EXPECT_EQ(parseServerUrl("host:90"), (ServerUrl{"host", 90, "/stream"}));
  EXPECT_EQ(parseServerUrl("http://host:90/"), (ServerUrl{"host", 90, "/stream"}));
  EXPECT_EQ(parseServerUrl("ws://host/behind/a/proxy"), (ServerUrl{"host", 8080, "/behind/a/proxy"}));
  EXPECT_EQ(parseServerUrl("ws://[::1]:90"), (ServerUrl{"::1", 90, "/stream"}));
  EXPECT_EQ(parseServerUrl("[::1]"), (ServerUrl{"::1", 8080, "/stream"}));
  EXPECT_EQ(parseServerUrl("wss://host:90"), (ServerUrl{"host", 90, "/stream", true}));
  EXPECT_EQ(parseServerUrl("https://host/"), (ServerUrl{"host", 8080, "/stream", true}));
}

TEST(ServerUrl, WritesItselfSoThatItIsReadBack) {
  for (const char* text : {"ws://host:1/stream", "ws://[::1]:65535/deep/path", "wss://host:1/stream"}) {
    EXPECT_EQ(parseServerUrl(text).text(), text);
  }
}

TEST(ServerUrl, RefusesWhatIsNoAddress) {
  for (const char* text : {"", "ws://", "ws://:80", "ftp://host", "wss://", "host:", "host:0", "host:65536", "host:8o",
                           "[::1", "[]:80", "[::1]80", "me@host", "a host", "host/a path"}) {
    EXPECT_THROW(parseServerUrl(text), UsageError) << text;
  }
}

TEST(OptionValues, ReadVectors) {
  const v1::Vec3 vector = parseVector("1,-2.5,3e2");
  EXPECT_EQ(vector.x(), 1);
  EXPECT_EQ(vector.y(), -2.5);
  EXPECT_EQ(vector.z(), 300);
  EXPECT_EQ(formatVector(vector), "1,-2.5,300");
  for (const char* text : {"", "1", "1,2", "1,2,", "1,2,3,4", "1,2,x", "1,2,nan", "1,2,inf", "1, 2,3"}) {
    EXPECT_THROW(parseVector(text), UsageError) << text;
  }
}

TEST(OptionValues, WriteNumbersThatReadBackTheSame) {
  EXPECT_EQ(formatExact(0.1), "0.1");
  EXPECT_EQ(std::stod(formatExact(1.0 / 3)), 1.0 / 3);
}

TEST(OptionValues, ReadSizes) {
  EXPECT_EQ(parseSize("640x480").width, 640U);
  EXPECT_EQ(parseSize("640x480").height, 480U);
  for (const char* text : {"", "640", "640x", "x480", "0x480", "640x0", "-1x2", "640x480x3", "640*480"}) {
    EXPECT_THROW(parseSize(text), UsageError) << text;
  }
}

TEST(OptionValues, ReadCamerasOverABase) {
  v1::Camera base;
  base.mutable_up()->set_z(1);
  base.set_vertical_fov_degrees(30);
  const v1::Camera camera = parseCamera("1,2,3:4,5,6", base);
  EXPECT_EQ(formatVector(camera.eye()), "1,2,3");
  EXPECT_EQ(formatVector(camera.target()), "4,5,6");
  EXPECT_EQ(camera.up().z(), 1);
  EXPECT_EQ(camera.vertical_fov_degrees(), 30);
  EXPECT_EQ(parseCamera("1,2,3:4,5,6:60", base).vertical_fov_degrees(), 60);
  for (const char* text : {"", "1,2,3", "1,2,3:", "1,2,3:4,5,6:", "1,2,3:4,5,6:wide", "1,2,3:4,5,6:7:8"}) {
    EXPECT_THROW(parseCamera(text, base), UsageError) << text;
  }
}

}  // namespace
}  // namespace sluice::client
