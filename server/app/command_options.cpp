#include "command_options.h"

#include <charconv>
#include <cmath>
#include <sstream>

#include <CLI/CLI.hpp>

#include "sluice/core/input_error.h"

namespace sluice::app {

namespace {

template <class T>
std::optional<T> number(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if constexpr (std::is_floating_point_v<T>) {
    if (!std::isfinite(value)) return std::nullopt;
  }
  return value;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
  return parts;
}

std::optional<Eigen::Vector3f> point(const std::string& text) {
  const std::vector<std::string> parts = split(text, ',');
  if (parts.size() != 3) return std::nullopt;
  Eigen::Vector3f p;
  for (int axis = 0; axis < 3; ++axis) {
    const auto value = number<float>(parts[axis]);
    if (!value) return std::nullopt;
    p[axis] = *value;
  }
  return p;
}

}  // namespace

LiveScene SceneOptions::load() const {
  std::vector<std::string> all = assignments;
  if (seed) all.push_back("seed=" + std::to_string(*seed));
  return loadScene(scene, all);
}

void addSceneOptions(CLI::App& verb, SceneOptions& options, const std::string& defaultScene, bool printsFigures) {
  options.scene = defaultScene;
  CLI::Option* scene = verb.add_option(
      "SCENE", options.scene, "A shipped scene, a .textproto, or a particle file or sequence (cache/frame_####.bgeo)");
  if (defaultScene.empty()) {
    scene->required();
  } else {
    scene->capture_default_str();
  }
  verb.add_option("--set", options.assignments, "PATH=VALUE: change a field of the scene; see the verb 'parameters'")
      ->allow_extra_args(false)
      ->take_all();
  verb.add_option("--seed", options.seed, "Seed of everything random");
  verb.add_option("--threads", options.threads, "Threads of the simulation; 0: one for each core")
      ->check(CLI::Range(0, 1024));
  if (printsFigures) verb.add_flag("--json", options.json, "Print the figures as one JSON object on the last line");
}

core::ImageSize parseSize(const std::string& text) {
  const std::vector<std::string> parts = split(text, 'x');
  constexpr int kMax = 16384;
  if (parts.size() == 2) {
    const auto width = number<int>(parts[0]);
    const auto height = number<int>(parts[1]);
    if (width && height && *width >= 1 && *height >= 1 && *width <= kMax && *height <= kMax) return {*width, *height};
  }
  throw core::InputError("", "--size", "\"" + text + "\" is not WIDTHxHEIGHT with both in [1, 16384]");
}

core::Camera parseCamera(const std::string& text, core::Camera fallback) {
  const std::vector<std::string> parts = split(text, ':');
  if (parts.size() == 2 || parts.size() == 3) {
    const auto eye = point(parts[0]);
    const auto target = point(parts[1]);
    const auto fov = parts.size() == 3 ? number<float>(parts[2]) : fallback.verticalFovDegrees;
    if (eye && target && fov && *fov >= 1.0F && *fov <= 150.0F) return {*eye, *target, fallback.up, *fov};
  }
  throw core::InputError("", "--camera", "\"" + text + "\" is not x,y,z:x,y,z[:fovDegrees] with the angle in [1, 150]");
}

ListenAddress parseListenAddress(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon != std::string::npos && colon > 0) {
    std::string address = text.substr(0, colon);
    if (address.size() > 2 && address.front() == '[' && address.back() == ']') {
      address = address.substr(1, address.size() - 2);
    }
    if (const auto port = number<std::uint16_t>(text.substr(colon + 1))) return {address, *port};
  }
  throw core::InputError("", "--listen", "\"" + text + "\" is not ADDRESS:PORT with the port in [0, 65535]");
}

FrameRange parseFrameRange(const std::string& text) {
  const std::vector<std::string> parts = split(text, ':');
  if (parts.size() == 2) {
    const auto first = number<int>(parts[0]);
    const auto last = number<int>(parts[1]);
    if (first && last && *first >= 0 && *first <= *last) return {*first, *last};
  }
  throw core::InputError("", "--frames", "\"" + text + "\" is not FIRST:LAST with 0 <= FIRST <= LAST");
}

}  // namespace sluice::app
