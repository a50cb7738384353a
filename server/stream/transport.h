#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/as_tuple.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core/basic_stream.hpp>
#include <chrono>
#include <cstddef>
#include <limits>

namespace sluice::stream {

namespace asio = boost::asio;
namespace beast = boost::beast;

/// Makes `co_await` give a tuple that starts with the error code, instead of throwing.
inline constexpr auto kAsTuple = asio::as_tuple(asio::use_awaitable);

/// Remembers when a connection last took bytes of ours, however far a message is. Takes the place of a rate policy in
/// Beast's stream, which is told of every transfer, and limits nothing.
class WriteProgress {
 public:
  std::chrono::steady_clock::time_point lastWrite() const { return lastWrite_; }

 private:
  friend class beast::rate_policy_access;

  static constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

  // Names that Beast's RatePolicy concept gives.
  std::size_t available_read_bytes() const { return kUnlimited; }
  std::size_t available_write_bytes() const { return kUnlimited; }
  void transfer_read_bytes(std::size_t) const {}
  void transfer_write_bytes(std::size_t) { lastWrite_ = std::chrono::steady_clock::now(); }
  void on_timer() const {}

  std::chrono::steady_clock::time_point lastWrite_;
};

/// A TCP connection on its strand.
using Transport = beast::basic_stream<asio::ip::tcp, asio::any_io_executor, WriteProgress>;

}  // namespace sluice::stream
