#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace sluice::stream {

struct StaticFile {
  std::filesystem::path path;
  std::string_view contentType;
  std::string etag;        ///< Changes when the file does.
  bool immutable = false;  ///< Its name holds a hash of what it holds.
};

/// Finds the files of the page. Thread-safe.
class StaticFiles {
 public:
  /// An empty root has no files.
  explicit StaticFiles(std::filesystem::path root);

  /// `target` is that of an HTTP request: a percent-encoded path, perhaps with a query. None where there is no such
  /// regular file inside the root; hidden files do not exist, and neither does what a link leads to outside.
  std::optional<StaticFile> find(std::string_view target) const;

 private:
  std::filesystem::path root_;
};

/// The path of a request's target without query, percent-decoded; none where the encoding is broken.
std::optional<std::string> decodedPath(std::string_view target);

}  // namespace sluice::stream
