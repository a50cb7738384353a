// Films: from `sluice-server render`, and from `sluice record` of a running server.
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.h"
#include "sluice/media/libav.h"

namespace sluice::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

struct Film {
  int width = 0;
  int height = 0;
  double framesPerSecond = 0;
  double seconds = 0;
  int frames = 0;
  bool firstIsKey = false;
  bool evenlySpaced = true;
};

/// What a player finds in a file; throws std::runtime_error for what is none.
Film probe(const std::string& path) {
  AVFormatContext* context = nullptr;
  if (avformat_open_input(&context, path.c_str(), nullptr, nullptr) < 0) throw std::runtime_error(path + " is no film");
  Film film;
  avformat_find_stream_info(context, nullptr);
  const AVStream& stream = *context->streams[0];
  EXPECT_EQ(stream.codecpar->codec_id, AV_CODEC_ID_H264);
  EXPECT_EQ(stream.codecpar->color_space, AVCOL_SPC_BT709);
  film.width = stream.codecpar->width;
  film.height = stream.codecpar->height;
  film.framesPerSecond = av_q2d(stream.avg_frame_rate);
  film.seconds = static_cast<double>(context->duration) / AV_TIME_BASE;
  AVPacket* packet = av_packet_alloc();
  double last = 0;
  for (; av_read_frame(context, packet) == 0; ++film.frames, av_packet_unref(packet)) {
    const double time = static_cast<double>(packet->pts) * av_q2d(stream.time_base);
    if (film.frames == 0) film.firstIsKey = (packet->flags & AV_PKT_FLAG_KEY) != 0;
    if (film.frames > 0 && std::abs(time - last - 1 / film.framesPerSecond) > 1e-6) film.evenlySpaced = false;
    last = time;
  }
  av_packet_free(&packet);
  avformat_close_input(&context);
  return film;
}

class Movie : public testing::Test {
 protected:
  Movie() : folder_(fs::path(testing::TempDir()) / ("movie_" + testName())) { fs::create_directories(folder_); }
  ~Movie() override { fs::remove_all(folder_); }

  static std::string testName() { return testing::UnitTest::GetInstance()->current_test_info()->name(); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  fs::path folder_;
};

void expectFilm(const std::string& path, int width, int height, int frames, double framesPerSecond) {
  const Film film = probe(path);
  EXPECT_EQ(film.width, width);
  EXPECT_EQ(film.height, height);
  EXPECT_EQ(film.frames, frames);
  EXPECT_DOUBLE_EQ(film.framesPerSecond, framesPerSecond);
  EXPECT_NEAR(film.seconds, frames / framesPerSecond, 0.002);
  EXPECT_TRUE(film.firstIsKey);
  EXPECT_TRUE(film.evenlySpaced);
}

TEST_F(Movie, RenderWritesConstantFrameRate) {
  const Outcome outcome = runProgram({SLUICE_SERVER_PROGRAM, "render", "cube", "--frames", "0:11", "--fps", "30",
                                      "--size", "160x120", "--out", file("cube.mp4")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  expectFilm(file("cube.mp4"), 160, 120, 12, 30);
  EXPECT_FALSE(fs::exists(file("cube.mp4.part")));
}

TEST_F(Movie, WhatCannotBeWrittenIsToldBeforeAnythingIsDrawn) {
  const Outcome outcome = runProgram({SLUICE_SERVER_PROGRAM, "render", "cube", "--frames", "0:1", "--size", "64x64",
                                      "--out", file("nowhere/cube.mp4")});
  EXPECT_EQ(outcome.exitCode, 2);
  EXPECT_THAT(outcome.err, HasSubstr("nowhere"));
}

/// A paused server of a small scene.
class Record : public Movie {
 protected:
  Record()
      : server_({SLUICE_SERVER_PROGRAM, "serve", "cube", "--listen", "127.0.0.1:0", "--set", "playback.paused=true"}) {
    const std::string line = server_.readLine();
    std::smatch found;
    if (!std::regex_search(line, found, std::regex("http://(\\S+)"))) throw std::runtime_error(line);
    address_ = "ws://" + found[1].str();
  }

  Outcome sluice(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {SLUICE_CLIENT_PROGRAM, "--server", address_, "--timeout", "60", "--json"});
    return runProgram(arguments);
  }

  Program server_;
  std::string address_;
};

TEST_F(Record, WritesEveryMomentOnce) {
  const Outcome outcome = sluice({"record", file("cube.mp4"), "--seconds", "0.4", "--fps", "25", "--size", "160x120"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out).at("frames"), 11);
  expectFilm(file("cube.mp4"), 160, 120, 11, 25);
  const auto info = nlohmann::json::parse(sluice({"info"}).out);
  EXPECT_THAT(info.dump(), HasSubstr("0.4"));
}

TEST_F(Record, WritesPicturesToAFolder) {
  const Outcome outcome = sluice({"record", file("pictures"), "--seconds", "0.1", "--fps", "20", "--size", "64x48"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  for (const char* name : {"frame_0000.png", "frame_0001.png", "frame_0002.png"}) {
    EXPECT_TRUE(fs::exists(folder_ / "pictures" / name)) << name;
  }
  EXPECT_FALSE(fs::exists(folder_ / "pictures/frame_0003.png"));
}

TEST_F(Record, KeepsWhatItHasWhenTheServerGoes) {
  Program recording(
      {SLUICE_CLIENT_PROGRAM, "--server", address_, "record", file("cut.mp4"), "--seconds", "1000", "--size", "64x48"});
  const fs::path part = file("cut.mp4.part");
  for (int k = 0; k < 600 && (!fs::exists(part) || fs::file_size(part) < 4000); ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  server_.terminate();
  EXPECT_EQ(recording.wait(), 3);
  EXPECT_GT(probe(file("cut.mp4")).frames, 1);
}

}  // namespace
}  // namespace sluice::test
