// The program `sluice` against the program `sluice-server`, as a person runs them.

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
using ::testing::IsEmpty;
using Json = nlohmann::json;

/// The last line of what was printed.
Json lastLine(const Outcome& outcome) {
  const std::string lines = outcome.out.substr(0, outcome.out.find_last_not_of('\n') + 1);
  return Json::parse(lines.substr(lines.rfind('\n') + 1));
}

/// A server of the default scene, paused, on a free port; and a folder for files.
class Cli : public testing::Test {
 protected:
  Cli()
      : server_(
            {SLUICE_SERVER_PROGRAM, "serve", "dam_break", "--listen", "127.0.0.1:0", "--set", "playback.paused=true"}) {
    const std::string greeting = server_.readLine();
    const std::string prefix = "listening on http://";
    if (!greeting.starts_with(prefix)) throw std::runtime_error("the server said: " + greeting);
    address_ = "ws://" + greeting.substr(prefix.size());

    std::string pattern = (std::filesystem::temp_directory_path() / "sluice_cli_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = pattern;
  }
  ~Cli() override { std::filesystem::remove_all(folder_); }

  Outcome sluice(const std::vector<std::string>& arguments) const {
    std::vector<std::string> command = {SLUICE_CLIENT_PROGRAM, "--server", address_, "--timeout", "60"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return runProgram(command);
  }

  /// What `info --json` says now.
  Json info() const { return lastLine(sluice({"info", "--json"})); }

  /// Runs a verb that must succeed, and returns its JSON.
  Json done(std::vector<std::string> arguments) const {
    arguments.emplace_back("--json");
    const Outcome outcome = sluice(arguments);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    return outcome.exitCode == 0 ? lastLine(outcome) : Json();
  }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  Program server_;
  std::string address_;

 private:
  std::filesystem::path folder_;
};

TEST_F(Cli, InfoTellsWhatRuns) {
  const Json json = info();
  EXPECT_EQ(json["scene_name"], "dam_break");
  EXPECT_FALSE(json["title"].get<std::string>().empty());
  EXPECT_FALSE(json["server_version"].get<std::string>().empty());
  EXPECT_FALSE(json["renderer"].get<std::string>().empty());
  EXPECT_GT(json["particles"], 5000);
  EXPECT_EQ(json["paused"], true);
  EXPECT_THAT(json["codecs"], testing::Contains("JPEG"));
  EXPECT_GT(json["limits"]["max_width"], 0);
  EXPECT_GE(json["scenes"].size(), 2U);
  EXPECT_THAT(sluice({"info"}).out, AllOf(HasSubstr("dam_break"), HasSubstr("paused")));
}

TEST_F(Cli, SetChangesAllThatIsGiven) {
  const Json json = done({"set", "look.smoothing.time=2.5", "simulation.fluids[0].viscosity=0.5",
                          "simulation.gravity=0,-3,1", "look.smoothing.bilateral={}"});
  EXPECT_EQ(json["restarted"], false);
  const Json scene = info()["scene"];
  EXPECT_EQ(scene["look"]["smoothing"]["time"], 2.5);
  EXPECT_TRUE(scene["look"]["smoothing"].contains("bilateral"));
  EXPECT_EQ(scene["simulation"]["fluids"][0]["viscosity"], 0.5);
  EXPECT_EQ(scene["simulation"]["gravity"]["y"], -3);
}

TEST_F(Cli, SetRefusedChangesNothing) {
  const Json before = info()["scene"];
  const Outcome outcome = sluice({"set", "look.liquid.physical.roughness=0.2", "look.smoothing.time=-1"});
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("look.smoothing.time"), HasSubstr("-1"), HasSubstr("50")))
      << "the field, the value, and what is allowed";
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_EQ(info()["scene"], before);
  EXPECT_EQ(sluice({"set", "simulation.fluids[0].blocks[900].count_x=2"}).exitCode, 1) << "no such element";
  EXPECT_EQ(info()["scene"], before);
}

TEST_F(Cli, SetOfAnUnknownPathIsBadUsage) {
  const Outcome outcome = sluice({"set", "look.smoothing.tim=1"});
  EXPECT_EQ(outcome.exitCode, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("look.smoothing.tim"), HasSubstr("curvature_flow")));
}

TEST_F(Cli, SetOfARestartingFieldRestarts) {
  EXPECT_GT(done({"step", "2"})["steps"], 0);
  EXPECT_EQ(done({"set", "seed=5"})["restarted"], true);
  EXPECT_EQ(info()["stats"]["simulation_time"], 0);
}

TEST_F(Cli, CameraShowsWhatItSets) {
  done({"camera", "--eye", "-2,1.5,4", "--fov", "30"});
  const Json json = done({"camera"});
  EXPECT_EQ(json["eye"], Json({-2.0, 1.5, 4.0}));
  EXPECT_EQ(json["vertical_fov_degrees"], 30);
  EXPECT_EQ(sluice({"camera", "--fov", "900"}).exitCode, 1);
}

TEST_F(Cli, TimeStepsPlaysPausesAndGoesBack) {
  EXPECT_EQ(info()["stats"]["simulation_time"], 0);
  const Json stepped = done({"step", "3"});
  EXPECT_EQ(stepped["steps"], 3);
  EXPECT_EQ(stepped["paused"], true);
  const double time = stepped["simulation_time"];
  EXPECT_GT(time, 0);
  EXPECT_EQ(info()["stats"]["simulation_time"], time) << "paused, nothing moves";

  EXPECT_EQ(done({"play"})["paused"], false);
  EXPECT_EQ(sluice({"watch", "--count", "3"}).exitCode, 0);
  const Json paused = done({"pause"});
  EXPECT_EQ(paused["paused"], true);
  EXPECT_GT(paused["simulation_time"], time);

  EXPECT_EQ(done({"reset"})["simulation_time"], 0);
  EXPECT_EQ(info()["stats"]["simulation_time"], 0);
}

TEST_F(Cli, LoadTakesNamesAndFiles) {
  EXPECT_EQ(done({"load", "double_dam_break"})["particles"], 29952);
  EXPECT_EQ(info()["scene_name"], "double_dam_break");

  std::ofstream(file("own.textproto")) << R"(
    title: "My own"
    simulation {
      container { min { x: 0 y: 0 z: 0 } max { x: 1 y: 1 z: 1 } }
      fluids { blocks { first_particle { x: 0.1 y: 0.1 z: 0.1 } count_x: 5 count_y: 4 count_z: 3 } }
    })";
  const Json own = done({"load", file("own.textproto")});
  EXPECT_EQ(own["title"], "My own");
  EXPECT_EQ(own["particles"], 60);
  EXPECT_EQ(info()["scene_name"], "");
}

TEST_F(Cli, LoadRefusedKeepsTheScene) {
  const Outcome unknown = sluice({"load", "no_such_scene"});
  EXPECT_EQ(unknown.exitCode, 1);
  EXPECT_THAT(unknown.err, AllOf(HasSubstr("no_such_scene"), HasSubstr("dam_break")));

  std::ofstream(file("bad.textproto")) << "simulation { particle_spacing: -1 }";
  const Outcome bad = sluice({"load", file("bad.textproto")});
  EXPECT_EQ(bad.exitCode, 1);
  EXPECT_THAT(bad.err, HasSubstr("particle_spacing"));

  EXPECT_EQ(sluice({"load", file("absent.textproto")}).exitCode, 2);
  EXPECT_EQ(info()["scene_name"], "dam_break");
}

/// Width and height of a PNG file: bytes 16 to 23, big-endian, behind the signature and the head of IHDR.
std::pair<unsigned, unsigned> pngSize(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  if (!bytes.starts_with("\x89PNG\r\n\x1a\n") || bytes.size() < 24) return {};
  const auto number = [&](std::size_t at) {
    unsigned value = 0;
    for (std::size_t i = at; i < at + 4; ++i) value = 256 * value + static_cast<unsigned char>(bytes[i]);
    return value;
  };
  return {number(16), number(20)};
}

TEST_F(Cli, SnapshotIsAPngOfTheSizeAskedFor) {
  const Json json = done({"snapshot", file("f.png"), "--size", "200x120", "--camera", "2,2,4:0,0.5,0:50"});
  EXPECT_EQ(pngSize(file("f.png")), std::pair(200U, 120U));
  EXPECT_EQ(json["bytes"], std::filesystem::file_size(file("f.png")));
  EXPECT_EQ(sluice({"snapshot", file("g.png"), "--size", "100000x100000"}).exitCode, 1);
  EXPECT_FALSE(std::filesystem::exists(file("g.png")));
  EXPECT_EQ(sluice({"snapshot", file("no/folder/f.png")}).exitCode, 1);
}

TEST_F(Cli, WatchPrintsAsManyReportsAsAskedFor) {
  done({"play"});
  const Outcome outcome = sluice({"watch", "--count", "3"});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 4) << "with the heading";
  const Json last = done({"watch", "--count", "2"});
  EXPECT_GT(last["steps"], 0);
  EXPECT_FALSE(last["stages"].empty());
}

TEST_F(Cli, BenchReportsTheAgreedFigures) {
  for (const char* codec : {"jpeg", "png"}) {
    const Json json = done({"bench", "--seconds", "1", "--size", "320x200", "--codec", codec});
    EXPECT_GT(json["input_to_decoded_ms"]["median"], 0) << codec;
    EXPECT_GE(json["input_to_decoded_ms"]["p99"], json["input_to_decoded_ms"]["p95"]);
    EXPECT_GT(json["frames_per_second"], 0);
    EXPECT_GT(json["kilobytes_per_second"], 0);
    EXPECT_FALSE(json["stages"].empty());
  }
}

TEST_F(Cli, ScriptRunsItsLines) {
  std::ofstream(file("tour")) << "# two steps\nstep 2\nset look.smoothing.time=3\nload no_such_scene\nreset\n";
  const Outcome outcome = sluice({"script", file("tour")});
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_THAT(outcome.err, HasSubstr("tour:4: "));
  EXPECT_EQ(info()["stats"]["steps"], 2) << "the line behind the failure has not run";
  EXPECT_EQ(info()["scene"]["look"]["smoothing"]["time"], 3);
}

TEST_F(Cli, NoServerIsThree) {
  server_.terminate();
  EXPECT_EQ(server_.wait(), 0);
  const Outcome outcome = sluice({"info"});
  EXPECT_EQ(outcome.exitCode, 3);
  EXPECT_THAT(outcome.err, HasSubstr("cannot connect to " + address_));
}

TEST(CliUsage, BadUsageIsTwo) {
  for (const char* argument : {"dance", "--loud"}) {
    const Outcome outcome = runProgram({SLUICE_CLIENT_PROGRAM, argument});
    EXPECT_EQ(outcome.exitCode, 2);
    EXPECT_FALSE(outcome.err.empty());
  }
  EXPECT_EQ(runProgram({SLUICE_CLIENT_PROGRAM, "--help"}).exitCode, 0);
}

}  // namespace
}  // namespace sluice::test
