#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sluice::sources {

/// The files that a path stands for, in the order of their numbers: those of a sequence where the file name has a run
/// of # signs ("cache/frame_####.bgeo": numbers of at least four digits), else the one file, which need not exist.
/// Throws core::InputError where no file matches and where a number is missing between the first and the last.
std::vector<std::filesystem::path> frameFiles(const std::string& path);

}  // namespace sluice::sources
