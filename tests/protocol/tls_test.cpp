// The same server behind TLS, with a certificate made for the test.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "live_server.h"
#include "sluice/core/input_error.h"
#include "viewer/raw_socket.h"

namespace sluice::stream::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

template <auto Free>
struct Freed {
  template <class T>
  void operator()(T* pointer) const {
    Free(pointer);
  }
};
template <class T, auto Free>
using Handle = std::unique_ptr<T, Freed<Free>>;
using Key = Handle<EVP_PKEY, EVP_PKEY_free>;

Key makeKey() { return Key(EVP_EC_gen("P-256")); }

void write(const fs::path& path, const std::function<int(std::FILE*)>& writer) {
  const Handle<std::FILE, std::fclose> file(std::fopen(path.c_str(), "w"));
  ASSERT_TRUE(file && writer(file.get()) == 1) << path;
}

struct TlsTest : testing::Test {
  void SetUp() override {
    folder = fs::path(testing::TempDir()) /
             (std::string("sluice_tls_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder);
    const Key key = makeKey();
    const Handle<X509, X509_free> certificate(X509_new());
    X509_set_version(certificate.get(), 2);
    ASN1_INTEGER_set(X509_get_serialNumber(certificate.get()), 1);
    X509_gmtime_adj(X509_getm_notBefore(certificate.get()), 0);
    X509_gmtime_adj(X509_getm_notAfter(certificate.get()), 3600);
    X509_set_pubkey(certificate.get(), key.get());
    X509_NAME* name = X509_get_subject_name(certificate.get());
    X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, reinterpret_cast<const unsigned char*>("localhost"), -1, -1,
                               0);
    X509_set_issuer_name(certificate.get(), name);
    X509_sign(certificate.get(), key.get(), EVP_sha256());
    write(folder / "cert.pem", [&](std::FILE* file) { return PEM_write_X509(file, certificate.get()); });
    write(folder / "key.pem", [&](std::FILE* file) {
      return PEM_write_PrivateKey(file, key.get(), nullptr, nullptr, 0, nullptr, nullptr);
    });
  }
  ~TlsTest() override { fs::remove_all(folder); }

  ServerOptions options() const {
    ServerOptions options;
    options.tls = TlsFiles{folder / "cert.pem", folder / "key.pem"};
    return options;
  }

  fs::path folder;
};

/// What a server answers to a request over TLS of one version; empty where there is no connection of that version.
std::string exchange(std::uint16_t port, int version, const std::string& request) {
  const Handle<SSL_CTX, SSL_CTX_free> context(SSL_CTX_new(TLS_client_method()));
  // What is old may only be tried at a lower level of security.
  SSL_CTX_set_security_level(context.get(), 0);
  SSL_CTX_set_min_proto_version(context.get(), version);
  SSL_CTX_set_max_proto_version(context.get(), version);
  const Handle<BIO, BIO_free_all> connection(BIO_new_ssl_connect(context.get()));
  BIO_set_conn_hostname(connection.get(), ("127.0.0.1:" + std::to_string(port)).c_str());
  if (BIO_do_connect(connection.get()) != 1 || BIO_do_handshake(connection.get()) != 1) return {};
  BIO_write(connection.get(), request.data(), static_cast<int>(request.size()));
  std::string answer;
  char bytes[4096];
  for (int count = 0; (count = BIO_read(connection.get(), bytes, sizeof bytes)) > 0;) {
    answer.append(bytes, static_cast<std::size_t>(count));
    if (answer.find("\r\n\r\n") != std::string::npos) break;
  }
  return answer;
}

constexpr const char* kHealth = "GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
constexpr const char* kUpgrade =
    "GET /stream HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n"
    "Sec-WebSocket-Protocol: sluice.v1\r\n\r\n";

TEST_F(TlsTest, SpeaksTls12And13AndNothingOlder) {
  const LiveServer server(options());
  EXPECT_THAT(exchange(server.port(), TLS1_2_VERSION, kHealth), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(exchange(server.port(), TLS1_3_VERSION, kHealth), StartsWith("HTTP/1.1 200"));
  EXPECT_EQ(exchange(server.port(), TLS1_1_VERSION, kHealth), "");
}

TEST_F(TlsTest, CarriesTheWebSocket) {
  const LiveServer server(options());
  EXPECT_THAT(exchange(server.port(), TLS1_3_VERSION, kUpgrade), StartsWith("HTTP/1.1 101"));
}

TEST_F(TlsTest, PlainRequestsAreNotAnsweredThere) {
  const LiveServer server(options());
  EXPECT_EQ(sluice::test::httpGet(server.port(), "/healthz").find("HTTP/1.1 200"), std::string::npos);
}

TEST_F(TlsTest, FilesThatDoNotFitAreRefusedByName) {
  const auto problem = [&](const TlsFiles& files) -> std::string {
    ServerOptions bad;
    bad.port = 0;
    bad.tls = files;
    FakeBackend backend;
    try {
      Server server(bad, backend);
    } catch (const core::InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(problem({folder / "nowhere.pem", folder / "key.pem"}), HasSubstr("nowhere.pem"));
  const Key other = makeKey();
  write(folder / "other.pem", [&](std::FILE* file) {
    return PEM_write_PrivateKey(file, other.get(), nullptr, nullptr, 0, nullptr, nullptr);
  });
  EXPECT_THAT(problem({folder / "cert.pem", folder / "other.pem"}), HasSubstr("other.pem"));
}

}  // namespace
}  // namespace sluice::stream::test
