#include "tls.h"

#include <openssl/ssl.h>
#include <openssl/x509_vfy.h>
#include <boost/asio/ip/address.hpp>

#include "sluice/client/failure.h"

namespace sluice::client {

namespace ssl = boost::asio::ssl;

ssl::context makeTlsContext(const Access& access) {
  ssl::context context(ssl::context::tls_client);
  context.set_options(ssl::context::default_workarounds | ssl::context::no_tlsv1 | ssl::context::no_tlsv1_1);
  boost::system::error_code error;
  if (access.caFile.empty()) {
    context.set_default_verify_paths(error);
    if (error) throw UsageError("the system's certificates cannot be read: " + error.message());
  } else {
    context.load_verify_file(access.caFile, error);
    if (error) throw UsageError("--ca-file " + access.caFile + ": no certificates can be read: " + error.message());
  }
  return context;
}

void expectHost(SSL* connection, const std::string& host, bool verify) {
  boost::system::error_code notAnAddress;
  boost::asio::ip::make_address(host, notAnAddress);
  // Addresses are not named: RFC 6066, 3.
  if (notAnAddress) SSL_set_tlsext_host_name(connection, host.c_str());

  SSL_set_verify(connection, verify ? SSL_VERIFY_PEER : SSL_VERIFY_NONE, nullptr);
  if (!verify) return;
  X509_VERIFY_PARAM* expected = SSL_get0_param(connection);
  const int taken = notAnAddress ? X509_VERIFY_PARAM_set1_host(expected, host.c_str(), host.size())
                                 : X509_VERIFY_PARAM_set1_ip_asc(expected, host.c_str());
  // Without it every trusted certificate would do.
  if (taken != 1) throw ConnectionError("no certificate can be in the name of " + inQuotes(host));
}

std::string certificateProblem(const SSL* connection) {
  const long result = SSL_get_verify_result(connection);
  return result == X509_V_OK ? std::string() : X509_verify_cert_error_string(result);
}

}  // namespace sluice::client
