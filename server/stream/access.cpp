#include "sluice/stream/access.h"

#include <openssl/crypto.h>
#include <openssl/sha.h>

#include <array>

namespace sluice::stream {

namespace {

// Compares digests, so that neither contents nor length of the secret show in the time taken.
bool same(std::string_view shown, std::string_view secret) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> a{};
  std::array<unsigned char, SHA256_DIGEST_LENGTH> b{};
  SHA256(reinterpret_cast<const unsigned char*>(shown.data()), shown.size(), a.data());
  SHA256(reinterpret_cast<const unsigned char*>(secret.data()), secret.size(), b.data());
  return CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace

std::optional<v1::Role> Access::roleFor(std::string_view token, v1::Role wanted) const {
  if (!asksForToken()) return wanted == v1::SPECTATOR ? v1::SPECTATOR : v1::DRIVER;
  // Both are compared, always.
  const bool drives = same(token, driverToken);
  const bool looksOn = same(token, spectatorToken) && !spectatorToken.empty();
  if (drives) return wanted == v1::SPECTATOR ? v1::SPECTATOR : v1::DRIVER;
  if (looksOn && wanted != v1::DRIVER) return v1::SPECTATOR;
  return std::nullopt;
}

std::string_view bearerToken(std::string_view authorization) {
  constexpr std::string_view kScheme = "Bearer ";
  if (!authorization.starts_with(kScheme)) return {};
  authorization.remove_prefix(kScheme.size());
  return authorization;
}

}  // namespace sluice::stream
