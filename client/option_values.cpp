#include "sluice/client/option_values.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>

#include "sluice/client/failure.h"

namespace sluice::client {

namespace {

template <class Number>
std::optional<Number> parseNumber(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::optional<double> parseFinite(std::string_view text) {
  const std::optional<double> number = parseNumber<double>(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

/// Splits at the first `separator`; the second part is empty where there is none.
std::pair<std::string_view, std::string_view> cut(std::string_view text, char separator) {
  const auto at = text.find(separator);
  if (at == std::string_view::npos) return {text, {}};
  return {text.substr(0, at), text.substr(at + 1)};
}

[[noreturn]] void fail(std::string_view text, const std::string& allowed) {
  throw UsageError(inQuotes(text) + " is not " + allowed);
}

}  // namespace

v1::Vec3 parseVector(std::string_view text) {
  const auto [x, yz] = cut(text, ',');
  const auto [y, z] = cut(yz, ',');
  const std::optional<double> numbers[] = {parseFinite(x), parseFinite(y), parseFinite(z)};
  if (!numbers[0] || !numbers[1] || !numbers[2]) fail(text, "three numbers such as 1,2.5,-3");
  v1::Vec3 vector;
  vector.set_x(*numbers[0]);
  vector.set_y(*numbers[1]);
  vector.set_z(*numbers[2]);
  return vector;
}

PictureSize parseSize(std::string_view text) {
  const auto [widthText, heightText] = cut(text, 'x');
  const auto width = parseNumber<std::uint32_t>(widthText);
  const auto height = parseNumber<std::uint32_t>(heightText);
  if (!width || !height || *width == 0 || *height == 0) fail(text, "a size in pixels such as 1280x720");
  return {*width, *height};
}

PicturePoint parsePicturePoint(std::string_view text) {
  const auto [xText, yText] = cut(text, ',');
  const std::optional<double> x = parseFinite(xText);
  const std::optional<double> y = parseFinite(yText);
  const auto isShare = [](const std::optional<double>& share) { return share && *share >= 0 && *share <= 1; };
  if (!isShare(x) || !isShare(y))
    fail(text, "a point of the picture such as 0.5,0.25 (from the left and the top, 0 to 1)");
  return {*x, *y};
}

v1::Camera parseCamera(std::string_view text, const v1::Camera& base) {
  const std::string allowed =
      "a camera such as 2,1.5,3:0,0,0 or 2,1.5,3:0,0,0:45 (eye, target, field of view in degrees)";
  const auto [eye, rest] = cut(text, ':');
  const auto [target, fov] = cut(rest, ':');
  v1::Camera camera = base;
  try {
    *camera.mutable_eye() = parseVector(eye);
    *camera.mutable_target() = parseVector(target);
  } catch (const UsageError&) {
    fail(text, allowed);
  }
  if (rest.find(':') != std::string_view::npos) {
    const std::optional<double> degrees = parseFinite(fov);
    if (!degrees) fail(text, allowed);
    camera.set_vertical_fov_degrees(*degrees);
  }
  return camera;
}

std::string formatExact(double number) {
  // Seventeen digits, a sign, a point and an exponent are the most that a double needs.
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  return {digits.data(), end};
}

std::string formatVector(const v1::Vec3& vector) {
  return formatExact(vector.x()) + "," + formatExact(vector.y()) + "," + formatExact(vector.z());
}

}  // namespace sluice::client
