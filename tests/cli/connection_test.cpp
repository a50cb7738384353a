// How the program `sluice` reaches a server of its own process: over TLS, and again after the server was killed.
#include <filesystem>
#include <memory>
#include <regex>
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
using ::testing::AllOf;
using ::testing::HasSubstr;
using Json = nlohmann::json;

const std::string kServer = SLUICE_SERVER_PROGRAM;
const std::string kClient = SLUICE_CLIENT_PROGRAM;

/// host:port in the line that the server prints when it is ready.
std::string authorityOf(Program& server) {
  const std::string line = server.readLine();
  std::smatch found;
  if (!std::regex_search(line, found, std::regex("listening on https?://([^/\\s]+)"))) throw std::runtime_error(line);
  return found[1].str();
}

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (fs::temp_directory_path() / "sluice_tls_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = pattern;
  }
  ~TemporaryFolder() { fs::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

/// Signs a certificate for this subject, such as "IP:127.0.0.1", by itself.
void makeCertificate(const std::string& certificate, const std::string& key, const std::string& subject) {
  const Outcome made = runProgram({"/usr/bin/openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt",
                                   "ec_paramgen_curve:prime256v1", "-nodes", "-days", "2", "-subj", "/CN=sluice-test",
                                   "-addext", "subjectAltName=" + subject, "-keyout", key, "-out", certificate});
  if (made.exitCode != 0) throw std::runtime_error(made.err);
}

TEST(Tls, ServersAreTrustedByTheirCertificate) {
  const TemporaryFolder folder;
  makeCertificate(folder.file("cert.pem"), folder.file("key.pem"), "IP:127.0.0.1");
  Program server({kServer, "serve", "cube", "--listen", "127.0.0.1:0", "--set", "playback.paused=true", "--tls-cert",
                  folder.file("cert.pem"), "--tls-key", folder.file("key.pem")});
  const std::string authority = authorityOf(server);

  const Outcome refused = runProgram({kClient, "--server", "wss://" + authority, "info"});
  EXPECT_EQ(refused.exitCode, 3);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("certificate is not trusted"), HasSubstr("--ca-file")));

  for (const std::string scheme : {"wss://", "https://"}) {
    const Outcome trusted =
        runProgram({kClient, "--server", scheme + authority, "--ca-file", folder.file("cert.pem"), "info", "--json"});
    EXPECT_EQ(trusted.exitCode, 0) << trusted.err;
    EXPECT_EQ(Json::parse(trusted.out).at("scene_name"), "cube");
  }
  EXPECT_EQ(runProgram({kClient, "--server", "wss://" + authority, "--insecure", "pause"}).exitCode, 0);
  EXPECT_EQ(runProgram({kClient, "--server", "ws://" + authority, "--timeout", "5", "info"}).exitCode, 3)
      << "without TLS there is no talking to it";
}

TEST(Tls, CertificatesOfOtherHostsAreRefused) {
  const TemporaryFolder folder;
  makeCertificate(folder.file("cert.pem"), folder.file("key.pem"), "DNS:elsewhere.example,IP:192.0.2.1");
  Program server({kServer, "serve", "cube", "--listen", "127.0.0.1:0", "--set", "playback.paused=true", "--tls-cert",
                  folder.file("cert.pem"), "--tls-key", folder.file("key.pem")});
  const Outcome outcome =
      runProgram({kClient, "--server", "wss://" + authorityOf(server), "--ca-file", folder.file("cert.pem"), "info"});
  EXPECT_EQ(outcome.exitCode, 3);
  EXPECT_THAT(outcome.err, HasSubstr("mismatch"));
}

TEST(Watch, GoesOnWhenAKilledServerIsStartedAgain) {
  const auto start = [](const std::string& listen) {
    return std::make_unique<Program>(std::vector<std::string>{kServer, "serve", "cube", "--listen", listen});
  };
  std::unique_ptr<Program> server = start("127.0.0.1:0");
  const std::string authority = authorityOf(*server);

  Program watch({kClient, "--server", "ws://" + authority, "watch", "--json", "--count", "6"});
  for (int i = 0; i < 3; ++i) EXPECT_GT(Json::parse(watch.readLine()).at("particles"), 0);
  server.reset();  // SIGKILL
  server = start(authority);
  EXPECT_EQ(authorityOf(*server), authority);
  for (int i = 0; i < 3; ++i) EXPECT_GT(Json::parse(watch.readLine()).at("particles"), 0);
  EXPECT_EQ(watch.wait(), 0);
  EXPECT_THAT(watch.err(),
              AllOf(HasSubstr("has ended"), HasSubstr("trying again in 0.25 s"), HasSubstr("connected again")));
}

}  // namespace
}  // namespace sluice::test
