#include "frame_files.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <map>
#include <optional>
#include <system_error>

#include "sluice/core/input_error.h"

namespace sluice::sources {

namespace fs = std::filesystem;

namespace {

/// A file name around the digits of its number.
struct Pattern {
  std::string before;
  std::string after;
  std::size_t width = 0;

  std::string nameOf(std::uint64_t number) const {
    std::string digits = std::to_string(number);
    digits.insert(0, width - std::min(width, digits.size()), '0');
    return before + digits + after;
  }

  std::optional<std::uint64_t> numberOf(const std::string& name) const {
    if (name.size() < before.size() + width + after.size()) return std::nullopt;
    if (!name.starts_with(before) || !name.ends_with(after)) return std::nullopt;
    const std::string digits = name.substr(before.size(), name.size() - before.size() - after.size());
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
    // frame_00012 is not the name of number 12 in frame_####.
    return nameOf(number) == name ? std::optional(number) : std::nullopt;
  }
};

}  // namespace

std::vector<fs::path> frameFiles(const std::string& path) {
  const fs::path given(path);
  const std::string name = given.filename().string();
  const std::size_t first = name.find('#');
  std::error_code error;
  if (first == std::string::npos || fs::exists(given, error)) return {given};
  const std::size_t last = std::min(name.find_first_not_of('#', first), name.size());
  if (name.find('#', last) != std::string::npos) {
    throw core::InputError(path, "", "has two runs of # signs; the number of a frame has one");
  }
  const Pattern pattern{name.substr(0, first), name.substr(last), last - first};

  const fs::path folder = given.has_parent_path() ? given.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) throw core::InputError(path, "", folder.string() + " is no folder");
  std::map<std::uint64_t, fs::path> found;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (const auto number = pattern.numberOf(entry->path().filename().string())) found[*number] = entry->path();
  }
  if (error) throw core::InputError(path, "", folder.string() + " cannot be read: " + error.message());
  if (found.empty()) throw core::InputError(path, "", "no file has such a name, like " + pattern.nameOf(1));

  std::vector<fs::path> files;
  std::uint64_t expected = found.begin()->first;
  for (const auto& [number, file] : found) {
    if (number != expected) {
      throw core::InputError(path, "",
                             "the sequence has a gap: " + pattern.nameOf(expected) + " is missing, " +
                                 pattern.nameOf(found.begin()->first) + " to " + pattern.nameOf(found.rbegin()->first) +
                                 " are expected");
    }
    files.push_back(file);
    ++expected;
  }
  return files;
}

}  // namespace sluice::sources
