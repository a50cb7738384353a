#include "view_request.h"

#include <algorithm>
#include <cmath>

#include "codec.h"
#include "sluice/core/input_error.h"
#include "sluice/scene/convert.h"
#include "sluice/scene/scene.h"

namespace sluice::stream {

namespace {

// What a viewer gets that names no quality: hard to tell from the original on moving water.
constexpr int kDefaultQuality = 85;
constexpr int kMaxQuality = 100;

std::string outside(const std::string& value, const std::string& low, const std::string& high) {
  return value + " is outside [" + low + ", " + high + "]";
}

int checkedEdge(std::uint32_t value, std::uint32_t limit, const std::string& path) {
  if (value < 1 || value > limit) {
    throw core::InputError("", path, outside(std::to_string(value), "1", std::to_string(limit)) + " pixels");
  }
  return static_cast<int>(value);
}

std::string plain(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

core::Codec negotiated(const v1::SetView& request, std::span<const v1::Codec> offered) {
  if (request.codecs().empty()) return core::Codec::Jpeg;
  for (const int wanted : request.codecs()) {
    const auto found = std::find(offered.begin(), offered.end(), wanted);
    if (found == offered.end()) continue;
    if (const auto codec = fromProto(*found)) return *codec;
  }
  std::string names;
  for (const v1::Codec codec : offered) names += (names.empty() ? "" : ", ") + v1::Codec_Name(codec);
  throw core::InputError("", "set_view.codecs", "none of them is known here; allowed are " + names);
}

}  // namespace

core::ImageSize checkedSize(std::uint32_t width, std::uint32_t height, const v1::Limits& limits,
                            const std::string& message) {
  return {checkedEdge(width, limits.max_width(), message + ".width"),
          checkedEdge(height, limits.max_height(), message + ".height")};
}

View checkedView(const v1::SetView& request, const v1::Limits& limits, std::span<const v1::Codec> codecs) {
  View view;
  view.size = checkedSize(request.width(), request.height(), limits, "set_view");
  view.codec = negotiated(request, codecs);

  if (request.quality() > kMaxQuality) {
    throw core::InputError("", "set_view.quality",
                           outside(std::to_string(request.quality()), "0", std::to_string(kMaxQuality)));
  }
  view.quality = request.quality() == 0 ? kDefaultQuality : static_cast<int>(request.quality());

  // Written so that NaN is refused too.
  if (!(request.max_rate() >= 0 && request.max_rate() <= limits.max_rate())) {
    throw core::InputError("", "set_view.max_rate",
                           outside(plain(request.max_rate()), "0", plain(limits.max_rate())) + " 1/s");
  }
  view.maxRate = request.max_rate() == 0 ? limits.max_rate() : request.max_rate();
  return view;
}

core::Camera checkedCamera(v1::Camera camera) {
  scene::complete(camera);
  scene::validate(camera, "camera");
  return scene::toCamera(camera);
}

}  // namespace sluice::stream
