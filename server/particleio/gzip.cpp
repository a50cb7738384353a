#include "gzip.h"

#include <algorithm>
#include <limits>
#include <memory>

#include <zlib.h>

#include "sluice/core/check.h"
#include "sluice/core/input_error.h"

namespace sluice::particleio {

namespace {

// 15 bits of window, and 16 for a gzip header instead of zlib's own.
constexpr int kGzipWindow = 15 + 16;
constexpr std::size_t kChunk = 1U << 18U;

}  // namespace

bool isGzip(std::span<const std::uint8_t> bytes) { return bytes.size() >= 2 && bytes[0] == 0x1f && bytes[1] == 0x8b; }

std::vector<std::uint8_t> gunzip(std::span<const std::uint8_t> bytes, const std::string& name, std::size_t largest) {
  z_stream stream{};
  SLUICE_CHECK_EQ(inflateInit2(&stream, kGzipWindow), Z_OK);
  const std::unique_ptr<z_stream, int (*)(z_stream*)> guard(&stream, &inflateEnd);

  std::vector<std::uint8_t> result;
  std::size_t consumed = 0;
  int status = Z_OK;
  while (status != Z_STREAM_END) {
    if (stream.avail_in == 0) {
      // avail_in has 32 bits; a file may have more.
      const std::size_t piece = std::min<std::size_t>(bytes.size() - consumed, std::numeric_limits<uInt>::max());
      stream.next_in = const_cast<Bytef*>(bytes.data() + consumed);  // zlib's interface is older than const
      stream.avail_in = static_cast<uInt>(piece);
      consumed += piece;
    }
    const std::size_t before = result.size();
    if (before >= largest) {
      throw core::InputError(name, "", "unpacks to more than " + std::to_string(largest) + " bytes");
    }
    result.resize(before + kChunk);
    stream.next_out = result.data() + before;
    stream.avail_out = static_cast<uInt>(kChunk);
    status = inflate(&stream, Z_NO_FLUSH);
    result.resize(before + kChunk - stream.avail_out);
    if (status == Z_BUF_ERROR) {  // no progress: the input has ended
      throw core::InputError(name, "", "the gzip data is cut off after " + std::to_string(bytes.size()) + " bytes");
    }
    if (status != Z_OK && status != Z_STREAM_END) {
      throw core::InputError(
          name, "",
          "the gzip data is damaged" + (stream.msg != nullptr ? ": " + std::string(stream.msg) : std::string()));
    }
  }
  return result;
}

std::vector<std::uint8_t> gzip(std::span<const std::uint8_t> bytes) {
  z_stream stream{};
  constexpr int kDefaultMemory = 8;
  SLUICE_CHECK_EQ(
      deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzipWindow, kDefaultMemory, Z_DEFAULT_STRATEGY), Z_OK);
  const std::unique_ptr<z_stream, int (*)(z_stream*)> guard(&stream, &deflateEnd);

  std::vector<std::uint8_t> result;
  std::size_t consumed = 0;
  int status = Z_OK;
  while (status != Z_STREAM_END) {
    if (stream.avail_in == 0 && consumed < bytes.size()) {
      const std::size_t piece = std::min<std::size_t>(bytes.size() - consumed, std::numeric_limits<uInt>::max());
      stream.next_in = const_cast<Bytef*>(bytes.data() + consumed);
      stream.avail_in = static_cast<uInt>(piece);
      consumed += piece;
    }
    const std::size_t before = result.size();
    result.resize(before + kChunk);
    stream.next_out = result.data() + before;
    stream.avail_out = static_cast<uInt>(kChunk);
    status = deflate(&stream, consumed == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
    SLUICE_CHECK(status == Z_OK || status == Z_STREAM_END);
    result.resize(before + kChunk - stream.avail_out);
  }
  return result;
}

}  // namespace sluice::particleio
