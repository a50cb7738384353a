#include "view_request.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "sluice/core/input_error.h"
#include "sluice/scene/convert.h"
#include "sluice/scene/scene.h"
#include "sluice/stream/codec.h"

namespace sluice::stream {

namespace {

// What a viewer gets that names no quality: hard to tell from the original on moving water.
constexpr int kDefaultQuality = 85;
constexpr int kMaxQuality = 100;
// One picture in a hundred seconds: what asks for less gets this.
constexpr double kMinRate = 0.01;

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

// Those that both sides know, in the viewer's order.
std::vector<core::Codec> negotiated(const v1::SetView& request, std::span<const v1::Codec> offered) {
  if (request.codecs().empty()) return {core::Codec::Jpeg};
  std::vector<core::Codec> common;
  for (const int wanted : request.codecs()) {
    if (std::find(offered.begin(), offered.end(), wanted) == offered.end()) continue;
    const auto codec = fromProto(static_cast<v1::Codec>(wanted));
    if (codec && std::find(common.begin(), common.end(), *codec) == common.end()) common.push_back(*codec);
  }
  if (!common.empty()) return common;
  std::string names;
  for (const v1::Codec codec : offered) names += (names.empty() ? "" : ", ") + v1::Codec_Name(codec);
  throw core::InputError("", "set_view.codecs", "none of them is known here; allowed are " + names);
}

// Written so that NaN is refused too.
void checkRange(double value, double low, double high, const std::string& path, const std::string& unit) {
  if (!(value >= low && value <= high)) {
    throw core::InputError("", path, outside(plain(value), plain(low), plain(high)) + unit);
  }
}

void checkVector(const v1::Vec3& vector, const std::string& path) {
  constexpr double kFar = 1e4;  // As far as a scene may reach.
  checkRange(vector.x(), -kFar, kFar, path + ".x", " m");
  checkRange(vector.y(), -kFar, kFar, path + ".y", " m");
  checkRange(vector.z(), -kFar, kFar, path + ".z", " m");
}

// The mode, and the figures that belong to it.
void takeMode(const v1::SetView& request, View& view) {
  if (!v1::QualityMode_IsValid(request.mode())) {
    throw core::InputError("", "set_view.mode", std::to_string(request.mode()) + " is no QualityMode");
  }
  view.mode = request.mode();
  if (view.mode == v1::LOSSLESS) view.codecs = {core::Codec::Png};
  if (view.mode != v1::FIXED_BIT_RATE) return;
  if (!core::isVideo(view.codecs.front())) {
    throw core::InputError("", "set_view.mode", "FIXED_BIT_RATE needs a video codec that both sides know");
  }
  checkRange(request.kilobits_per_second(), 100, 1'000'000, "set_view.kilobits_per_second", " kbit/s");
  view.kilobitsPerSecond = static_cast<int>(request.kilobits_per_second());
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
  view.codecs = negotiated(request, codecs);
  takeMode(request, view);

  checkRange(request.quality(), 0, kMaxQuality, "set_view.quality", "");
  view.quality = request.quality() == 0 ? kDefaultQuality : static_cast<int>(request.quality());
  checkRange(request.max_rate(), 0, limits.max_rate(), "set_view.max_rate", " 1/s");
  view.maxRate = request.max_rate() == 0 ? limits.max_rate() : std::max(request.max_rate(), kMinRate);
  view.follow = request.follow();
  view.fullChroma = request.full_chroma();
  view.stills = !request.no_still();
  return view;
}

void checkInteract(const v1::Interact& request) {
  if (request.action() == v1::Interact::ACTION_UNSPECIFIED || !v1::Interact::Action_IsValid(request.action())) {
    throw core::InputError("", "interact.action", std::to_string(request.action()) + " is none of PUSH, PULL, ADD");
  }
  checkVector(request.origin(), "interact.origin");
  checkVector(request.direction(), "interact.direction");
  const v1::Vec3& d = request.direction();
  if (std::hypot(d.x(), d.y(), d.z()) < 1e-9) throw core::InputError("", "interact.direction", "has no length");
  checkRange(request.radius(), 0, 1e3, "interact.radius", " m");
  checkRange(request.strength(), 0, 1e4, "interact.strength", " m/s²");
  checkRange(request.seconds(), 0, 1, "interact.seconds", " s");
}

PickPoint checkedPick(const v1::Pick& request) {
  checkRange(request.x(), 0, 1, "pick.x", "");
  checkRange(request.y(), 0, 1, "pick.y", "");
  PickPoint point{.x = request.x(), .y = request.y(), .camera = {}};
  if (request.has_camera()) point.camera = checkedCamera(request.camera());
  return point;
}

core::Camera checkedCamera(v1::Camera camera) {
  scene::complete(camera);
  scene::validate(camera, "camera");
  return scene::toCamera(camera);
}

}  // namespace sluice::stream
