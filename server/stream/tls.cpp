#include "tls.h"

#include <boost/system/error_code.hpp>

#include "sluice/core/input_error.h"

namespace sluice::stream {

namespace ssl = boost::asio::ssl;

boost::asio::ssl::context makeTlsContext(const std::filesystem::path& certificate, const std::filesystem::path& key) {
  ssl::context context(ssl::context::tls_server);
  context.set_options(ssl::context::default_workarounds | ssl::context::no_sslv2 | ssl::context::no_sslv3 |
                      ssl::context::no_tlsv1 | ssl::context::no_tlsv1_1 | ssl::context::single_dh_use);
  boost::system::error_code error;
  context.use_certificate_chain_file(certificate.string(), error);
  if (error) throw core::InputError(certificate.string(), "--tls-cert", "holds no certificate: " + error.message());
  context.use_private_key_file(key.string(), ssl::context::pem, error);
  if (error) {
    throw core::InputError(key.string(), "--tls-key",
                           "holds no private key that belongs to the certificate: " + error.message());
  }
  return context;
}

}  // namespace sluice::stream
