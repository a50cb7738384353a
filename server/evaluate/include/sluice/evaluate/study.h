#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sluice/evaluate/report.h"

namespace sluice::evaluate {

/// What a person asks of a study.
struct Options {
  bool quick = false;                    ///< Fewer cases, in under a minute.
  std::string only;                      ///< One part of the study; empty for all.
  std::string particles;                 ///< A particle file to study beside the made cases; empty for none.
  std::vector<std::string> assignments;  ///< "look.liquid.opaque=true", as with --set.
  std::uint64_t seed = 1;
  int threads = 0;               ///< Of simulations; 0: one for each core.
  std::filesystem::path folder;  ///< An existing folder that long studies keep what they have done in; empty: nowhere.
  bool resume = false;           ///< Go on with what an earlier study of the same options has left there.
  std::function<void(const std::string&)> progress;  ///< Is told each part as it begins; may be empty.

  void tell(const std::string& text) const {
    if (progress) progress(text);
  }
};

/// A study: measures, and reports. Adding one means adding a file and its line in `studies`.
struct Study {
  std::string_view name;
  std::string_view doc;                   ///< One line.
  std::vector<std::string> (*parts)();    ///< What `only` may name.
  Report (*run)(const Options& options);  ///< Throws core::InputError and core::EnvironmentError.
};

/// Every study, in the order in which `all` runs them.
std::span<const Study> studies();

/// The studies of that name; all of them for "all". Throws core::InputError, listing the names there are, for any other
/// name, and for a part that none of them has.
std::vector<Study> findStudies(std::string_view name, std::string_view only);

}  // namespace sluice::evaluate
