// What `serve` lets in, tells and leaves behind, as a process of its own.
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.h"

namespace sluice::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const std::string kServer = SLUICE_SERVER_PROGRAM;
const std::string kClient = SLUICE_CLIENT_PROGRAM;

class Serve : public testing::Test {
 protected:
  Serve() : folder_(fs::path(testing::TempDir()) / ("serve_" + testName())) { fs::create_directories(folder_); }
  ~Serve() override { fs::remove_all(folder_); }

  static std::string testName() { return testing::UnitTest::GetInstance()->current_test_info()->name(); }

  std::string file(const std::string& name, const std::string& content = {}) const {
    const fs::path path = folder_ / name;
    if (!content.empty()) std::ofstream(path) << content;
    return path.string();
  }

  /// The address for clients in the line that the server prints when it is ready.
  static std::string urlOf(Program& server) {
    const std::string line = server.readLine();
    std::smatch found;
    if (!std::regex_search(line, found, std::regex("listening on http(s?)://(\\S+)"))) throw std::runtime_error(line);
    return "ws" + found[1].str() + "://" + found[2].str();
  }

  fs::path folder_;
};

TEST_F(Serve, OtherAddressesThanTheLoopbackTakeATokenOrTheOperatorsWord) {
  for (const std::string address : {"0.0.0.0:0", "[::]:0"}) {
    const Outcome outcome = runProgram({kServer, "serve", "--listen", address});
    EXPECT_EQ(outcome.exitCode, 2) << address;
    EXPECT_THAT(outcome.err, HasSubstr("--token-file"));
  }
  Program insecure({kServer, "serve", "--listen", "0.0.0.0:0", "--insecure"});
  EXPECT_THAT(urlOf(insecure), HasSubstr("0.0.0.0"));
}

TEST_F(Serve, TokenFilesThatGuardNothingAreRefused) {
  EXPECT_EQ(runProgram({kServer, "serve", "--token-file", file("nowhere")}).exitCode, 2);
  const Outcome outcome = runProgram({kServer, "serve", "--token-file", file("short", "secret\n")});
  EXPECT_EQ(outcome.exitCode, 2);
  EXPECT_THAT(outcome.err, HasSubstr("16 characters"));
}

TEST_F(Serve, CertificateAndKeyBelongTogether) {
  const Outcome outcome = runProgram({kServer, "serve", "--tls-cert", file("cert.pem", "x")});
  EXPECT_EQ(outcome.exitCode, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--tls-key"));
}

TEST_F(Serve, LinesOfTheLogAreObjectsWhereAskedFor) {
  Program server({kServer, "serve", "--listen", "127.0.0.1:0", "--log-format", "json"});
  const std::string url = urlOf(server);
  EXPECT_EQ(runProgram({kClient, "--server", url, "info"}).exitCode, 0);
  server.terminate();
  EXPECT_EQ(server.wait(), 0);
  std::vector<std::string> events;
  std::istringstream lines(server.err());
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("{")) continue;
    const auto object = nlohmann::json::parse(line);
    EXPECT_TRUE(std::regex_match(object.at("time").get<std::string>(),
                                 std::regex(R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z)")));
    events.push_back(object.at("event"));
  }
  EXPECT_THAT(events, testing::IsSupersetOf({"serving", "viewer_connected", "viewer_left", "stopped"}));
}

TEST_F(Serve, ScenesOfViewersHaveNoMoreParticlesThanAllowed) {
  Program server({kServer, "serve", "--listen", "127.0.0.1:0", "--max-particles", "30000"});
  const std::string url = urlOf(server);
  const std::string large = file("large.textproto", R"(simulation { particle_spacing: 0.01
    container { min {} max { x: 2 y: 2 z: 2 } }
    fluids { blocks { first_particle { x: 0.5 y: 0.5 z: 0.5 } count_x: 50 count_y: 50 count_z: 50 } } })");
  const Outcome refused = runProgram({kClient, "--server", url, "load", large});
  EXPECT_EQ(refused.exitCode, 1);
  EXPECT_THAT(refused.err, HasSubstr("30000"));
  EXPECT_EQ(runProgram({kClient, "--server", url, "load", "cube"}).exitCode, 0) << "the server goes on";
}

TEST_F(Serve, ALogOfCommandsIsReplayed) {
  const std::string log = file("commands.log");
  {
    Program server({kServer, "serve", "cube", "--listen", "127.0.0.1:0", "--log-commands", log});
    const std::string url = urlOf(server);
    for (const std::vector<std::string>& verb :
         {std::vector<std::string>{"pause"}, {"step"}, {"set", "simulation.gravity=0,-5,0"}, {"step"}, {"step"}}) {
      std::vector<std::string> command{kClient, "--server", url};
      command.insert(command.end(), verb.begin(), verb.end());
      EXPECT_EQ(runProgram(command).exitCode, 0) << verb[0];
    }
    server.terminate();
    EXPECT_EQ(server.wait(), 0);
  }
  const std::string state = file("end.state");
  const Outcome replayed = runProgram({kServer, "replay", log, "--json", "--save", state});
  EXPECT_EQ(replayed.exitCode, 0) << replayed.err;
  const auto figures = nlohmann::json::parse(replayed.out);
  EXPECT_EQ(figures.at("same"), true);
  EXPECT_GE(figures.at("steps").get<int>(), 3);
  EXPECT_TRUE(fs::exists(state));
  EXPECT_EQ(runProgram({kServer, "replay", file("none", "no log")}).exitCode, 2);
}

}  // namespace
}  // namespace sluice::test
