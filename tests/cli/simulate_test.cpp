// `sluice-server simulate` as a person runs it: particles as files, states saved and resumed.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "print_json.h"
#include "program.h"

namespace sluice::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using Json = nlohmann::json;
namespace fs = std::filesystem;

/// Two liquids, so that every column is there.
constexpr const char* kScene = R"(
  simulation {
    particle_spacing: 0.05
    container { min { x: 0 y: 0 z: 0 } max { x: 0.9 y: 0.8 z: 0.45 } }
    fluids { blocks { first_particle { x: 0.05 y: 0.05 z: 0.05 } count_x: 7 count_y: 6 count_z: 8 } }
    fluids { rest_density: 700 blocks { first_particle { x: 0.05 y: 0.35 z: 0.05 } count_x: 7 count_y: 5 count_z: 8 } }
  })";
constexpr int kParticles = 7 * 11 * 8;

class Simulate : public testing::Test {
 protected:
  Simulate() {
    std::string pattern = (fs::temp_directory_path() / "sluice_simulate_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = pattern;
    std::ofstream(scene()) << kScene;
  }
  ~Simulate() override { fs::remove_all(folder_); }

  static Outcome simulate(std::vector<std::string> arguments) {
    std::vector<std::string> command = {SLUICE_SERVER_PROGRAM, "simulate"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    command.emplace_back("--json");
    return runProgram(command);
  }

  static Json done(const std::vector<std::string>& arguments) {
    const Outcome outcome = simulate(arguments);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    return outcome.exitCode == 0 ? Json::parse(outcome.out) : Json();
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string scene() const { return path("two.textproto"); }

  std::string contents(const std::string& name) const {
    std::ifstream stream(folder_ / name, std::ios::binary);
    EXPECT_TRUE(stream) << name;
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  fs::path folder_;
};

TEST_F(Simulate, WritesAFileForEveryFrameUpToTheEnd) {
  for (const char* format : {"bgeo", "vtk", "ply", "csv"}) {
    const Json json = done({scene(), "--until", "0.1", "--fps", "20", "--out", path(format), "--format", format});
    EXPECT_EQ(json["files"], 3);
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / format)) names.push_back(entry.path().filename());
    const std::string ending = std::string(".") + format;
    EXPECT_THAT(names,
                testing::UnorderedElementsAre("frame_0000" + ending, "frame_0001" + ending, "frame_0002" + ending));
    // Its own reader takes the sequence.
    EXPECT_EQ(done({path(format) + "/frame_####" + ending, "--until", "0.01"})["particles"], kParticles) << format;
  }
  EXPECT_THAT(contents("bgeo/frame_0001.bgeo"), StartsWith("\x1f\x8b")) << "gzip, as other programs write it";
  EXPECT_THAT(contents("vtk/frame_0001.vtk"), AllOf(StartsWith("# vtk DataFile"), HasSubstr("BINARY")));
  EXPECT_THAT(contents("ply/frame_0001.ply"),
              AllOf(HasSubstr("format binary_little_endian 1.0"), HasSubstr("property float x\nproperty float y"),
                    HasSubstr("property float vx")));
  EXPECT_THAT(contents("csv/frame_0001.csv"), StartsWith("x,y,z,vx,vy,vz,density,id,pressure,fluid\n"));
}

TEST_F(Simulate, TimesOfFramesAreExact) {
  const Json json = done({scene(), "--until", "0.3", "--fps", "10", "--out", path("out")});
  EXPECT_EQ(json["files"], 4);
  EXPECT_EQ(json["simulated_seconds"], 3 / 10.0);
}

TEST_F(Simulate, ResumedRunsAreTheUninterruptedOne) {
  const std::vector<std::string> frames = {"--fps", "20", "--format", "csv"};
  const auto run = [&](std::vector<std::string> arguments, const std::string& out) {
    arguments.insert(arguments.end(), frames.begin(), frames.end());
    arguments.insert(arguments.end(), {"--out", path(out)});
    return done(arguments);
  };
  run({scene(), "--until", "0.3", "--save", path("whole.state")}, "whole");
  // Once on a frame's time, once between two.
  run({scene(), "--until", "0.1", "--save", path("first.state"), "--threads", "1"}, "parts");
  run({"--resume", path("first.state"), "--until", "0.22", "--save", path("second.state")}, "parts");
  run({"--resume", path("second.state"), "--until", "0.3", "--save", path("last.state")}, "parts");
  for (int frame = 0; frame <= 6; ++frame) {
    const std::string name = "/frame_000" + std::to_string(frame) + ".csv";
    EXPECT_EQ(contents("parts" + name), contents("whole" + name)) << frame;
  }
  EXPECT_EQ(contents("last.state"), contents("whole.state"));
}

TEST_F(Simulate, ResumesWithoutFramesToo) {
  done({scene(), "--until", "0.1", "--save", path("half.state")});
  done({"--resume", path("half.state"), "--until", "0.2", "--save", path("resumed.state")});
  done({scene(), "--until", "0.2", "--save", path("whole.state")});
  EXPECT_EQ(contents("resumed.state"), contents("whole.state"));
}

TEST_F(Simulate, DamagedStatesAreInputErrors) {
  done({scene(), "--until", "0.02", "--save", path("good.state")});
  const std::string good = contents("good.state");
  const auto refused = [&](const std::string& bytes) {
    std::ofstream(path("bad.state"), std::ios::binary) << bytes;
    const Outcome outcome = simulate({"--resume", path("bad.state"), "--until", "0.1"});
    EXPECT_EQ(outcome.exitCode, 2);
    EXPECT_THAT(outcome.err, HasSubstr("bad.state"));
    return outcome.err;
  };
  EXPECT_THAT(refused(good.substr(0, good.size() / 2)), HasSubstr("cut off"));
  std::string flipped = good;
  flipped[good.size() / 2] = static_cast<char>(~flipped[good.size() / 2]);
  EXPECT_THAT(refused(flipped), HasSubstr("damaged"));
  EXPECT_THAT(refused("ply\n"), HasSubstr("is no saved state"));
  EXPECT_EQ(simulate({"--resume", path("absent.state")}).exitCode, 2);
  EXPECT_EQ(simulate({"--resume", folder_.string()}).exitCode, 2);
}

TEST_F(Simulate, FailuresToWriteNameThePath) {
  std::ofstream(path("file")) << "no folder";
  const Outcome notAFolder = simulate({scene(), "--until", "0.1", "--out", path("file/out")});
  EXPECT_EQ(notAFolder.exitCode, 2);
  EXPECT_THAT(notAFolder.err, AllOf(HasSubstr("file/out"), HasSubstr("--out")));

  // What is written to /dev/full finds no space left.
  fs::create_directory(folder_ / "full");
  fs::create_symlink("/dev/full", folder_ / "full" / "frame_0001.ply.part");
  const Outcome full = simulate({scene(), "--until", "0.1", "--fps", "20", "--out", path("full"), "--format", "ply"});
  EXPECT_EQ(full.exitCode, 2);
  EXPECT_THAT(full.err, AllOf(HasSubstr("full/frame_0001.ply"), HasSubstr("No space left")));
  EXPECT_TRUE(fs::exists(folder_ / "full" / "frame_0000.ply"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "full"), {}), 1) << "nothing half-written";

  const Outcome state = simulate({scene(), "--until", "0.1", "--save", path("none/run.state")});
  EXPECT_EQ(state.exitCode, 2);
  EXPECT_THAT(state.err, AllOf(HasSubstr("none"), HasSubstr("--save")));
}

TEST_F(Simulate, RefusesWhatDoesNotGoTogether) {
  done({scene(), "--until", "0.01", "--save", path("run.state"), "--out", path("csv"), "--format", "csv"});
  EXPECT_THAT(simulate({}).err, HasSubstr("SCENE"));
  EXPECT_EQ(simulate({scene(), "--resume", path("run.state")}).exitCode, 2);
  EXPECT_EQ(simulate({"--resume", path("run.state"), "--set", "seed=2"}).exitCode, 2);
  EXPECT_THAT(simulate({"--resume", path("run.state"), "--until", "0.001"}).err, HasSubstr("--until: lies before"));
  EXPECT_EQ(simulate({scene(), "--format", "docx", "--out", path("out")}).exitCode, 2);
  const Outcome played = simulate({path("csv/frame_0000.csv"), "--save", path("played.state")});
  EXPECT_EQ(played.exitCode, 2);
  EXPECT_THAT(played.err, AllOf(HasSubstr("--save"), HasSubstr("simulation")));
}

}  // namespace
}  // namespace sluice::test
