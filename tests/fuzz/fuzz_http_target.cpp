// The target of an HTTP request: whatever it says, nothing outside of the page's folder is found.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "static_files.h"

namespace {

namespace fs = std::filesystem;

const fs::path& folder() {
  static const fs::path made = [] {
    const fs::path base = fs::temp_directory_path() / "sluice_fuzz_http";
    fs::create_directories(base / "web/assets");
    std::ofstream(base / "web/index.html") << "page";
    std::ofstream(base / "web/assets/a.js") << "script";
    std::ofstream(base / "secret.txt") << "secret";
    return fs::canonical(base / "web");
  }();
  return made;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view target(reinterpret_cast<const char*>(data), size);
  sluice::stream::decodedPath(target);
  static const sluice::stream::StaticFiles files(folder());
  const auto file = files.find(target);
  if (file && file->path.string().rfind(folder().string() + "/", 0) != 0) std::abort();
  return 0;
}
