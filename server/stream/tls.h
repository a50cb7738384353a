#pragma once

#include <boost/asio/ssl/context.hpp>
#include <filesystem>

namespace sluice::stream {

/// A server's side of TLS 1.2 and later, with the certificate chain and the private key of two PEM files. Throws
/// core::InputError, which names the file, where one cannot be read or the two do not belong together.
boost::asio::ssl::context makeTlsContext(const std::filesystem::path& certificate, const std::filesystem::path& key);

}  // namespace sluice::stream
