#include "raw_socket.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "test_viewer.h"

namespace sluice::test {

RawSocket::RawSocket(std::uint16_t port) : descriptor_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
    const int error = errno;
    ::close(descriptor_);
    throw std::system_error(error, std::generic_category(), "cannot connect");
  }
}

RawSocket::~RawSocket() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool RawSocket::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

std::string RawSocket::readUntil(std::string_view end) {
  std::string text;
  std::array<char, 4096> block{};
  while (end.empty() || text.find(end) == std::string::npos) {
    pollfd ready{.fd = descriptor_, .events = POLLIN, .revents = 0};
    if (::poll(&ready, 1, static_cast<int>(kPatience.count())) == 0) throw TimedOut("nothing came; so far: " + text);
    const ssize_t count = ::recv(descriptor_, block.data(), block.size(), 0);
    if (count <= 0) break;
    text.append(block.data(), static_cast<std::size_t>(count));
  }
  return text;
}

std::string RawSocket::readAll() { return readUntil({}); }

void RawSocket::finishWriting() { ::shutdown(descriptor_, SHUT_WR); }

void RawSocket::vanish() {
  const linger reset{.l_onoff = 1, .l_linger = 0};
  ::setsockopt(descriptor_, SOL_SOCKET, SO_LINGER, &reset, sizeof(reset));
  ::close(descriptor_);
  descriptor_ = -1;
}

std::string httpExchange(std::uint16_t port, std::string_view request) {
  RawSocket socket(port);
  socket.write(request);
  return socket.readAll();
}

std::string httpGet(std::uint16_t port, const std::string& target, const std::string& headers) {
  return httpExchange(port,
                      "GET " + target + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" + headers + "\r\n");
}

}  // namespace sluice::test
