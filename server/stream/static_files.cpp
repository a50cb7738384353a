#include "static_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <sstream>
#include <utility>

namespace sluice::stream {

namespace {

namespace fs = std::filesystem;

constexpr auto kContentTypes = std::to_array<std::pair<std::string_view, std::string_view>>({
    {".css", "text/css; charset=utf-8"},
    {".html", "text/html; charset=utf-8"},
    {".ico", "image/x-icon"},
    {".jpg", "image/jpeg"},
    {".js", "text/javascript; charset=utf-8"},
    {".json", "application/json"},
    {".map", "application/json"},
    {".mjs", "text/javascript; charset=utf-8"},
    {".png", "image/png"},
    {".svg", "image/svg+xml"},
    {".txt", "text/plain; charset=utf-8"},
    {".wasm", "application/wasm"},
    {".webmanifest", "application/manifest+json"},
    {".woff2", "font/woff2"},
});

std::string_view contentTypeOf(const fs::path& path) {
  const std::string extension = path.extension().string();
  const auto* const found = std::find_if(kContentTypes.begin(), kContentTypes.end(),
                                         [&](const auto& entry) { return entry.first == extension; });
  return found != kContentTypes.end() ? found->second : "application/octet-stream";
}

// A path of plain names: none empty, none hidden, and so none that climbs ("..").
bool isPlain(std::string_view path) {
  if (!path.starts_with('/')) return false;
  // NUL ends a path early in the system's eyes.
  if (path.find('\0') != std::string_view::npos) return false;
  for (std::size_t slash = 0; slash != std::string_view::npos; slash = path.find('/', slash + 1)) {
    const char first = slash + 1 < path.size() ? path[slash + 1] : 'x';
    if (first == '.' || first == '/') return false;
  }
  return true;
}

// Vite writes assets/<name>-<8 characters of hash>.<extension>.
bool hasHashedName(const fs::path& path) {
  constexpr std::size_t kHashLength = 8;
  const std::string stem = path.stem().string();
  if (path.parent_path().filename() != "assets" || stem.size() <= kHashLength) return false;
  const auto hash = stem.end() - kHashLength;
  return hash[-1] == '-' &&
         std::all_of(hash, stem.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; });
}

bool isInside(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

std::string etagOf(const fs::path& path, std::error_code& error) {
  const auto size = fs::file_size(path, error);
  if (error) return {};
  const auto changed = fs::last_write_time(path, error).time_since_epoch().count();
  std::ostringstream tag;
  tag << '"' << std::hex << size << '-' << static_cast<std::uint64_t>(changed) << '"';
  return tag.str();
}

}  // namespace

std::optional<std::string> decodedPath(std::string_view target) {
  target = target.substr(0, target.find_first_of("?#"));
  std::string path;
  for (std::size_t i = 0; i < target.size(); ++i) {
    if (target[i] != '%') {
      path += target[i];
      continue;
    }
    if (i + 2 >= target.size()) return std::nullopt;
    unsigned value = 0;
    const char* const digits = target.data() + i + 1;
    const auto [end, error] = std::from_chars(digits, digits + 2, value, 16);
    if (error != std::errc() || end != digits + 2) return std::nullopt;
    path += static_cast<char>(value);
    i += 2;
  }
  return path;
}

StaticFiles::StaticFiles(fs::path root) : root_(std::move(root)) {}

std::optional<StaticFile> StaticFiles::find(std::string_view target) const {
  if (root_.empty()) return std::nullopt;
  auto path = decodedPath(target);
  if (!path || !isPlain(*path)) return std::nullopt;
  if (path->ends_with('/')) *path += "index.html";

  // The root is resolved at each request: the page may be built anew while the server runs.
  std::error_code error;
  const fs::path root = fs::canonical(root_, error);
  if (error) return std::nullopt;
  const fs::path file = fs::canonical(root / path->substr(1), error);
  if (error || !isInside(file, root) || !fs::is_regular_file(file, error)) return std::nullopt;

  StaticFile found{
      .path = file, .contentType = contentTypeOf(file), .etag = etagOf(file, error), .immutable = hasHashedName(file)};
  if (error) return std::nullopt;
  return found;
}

}  // namespace sluice::stream
