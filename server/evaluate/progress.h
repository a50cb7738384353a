#pragma once

#include <cstddef>
#include <string>

#include "sluice/evaluate/study.h"

namespace sluice::evaluate {

/// Tells how far a study is: "[####----------------] 12 of 60, 3 min left: elliptic drop, dfsph 0.05 %, 40".
class Progress {
 public:
  Progress(const Options& options, std::size_t parts);

  /// The next part begins. `kept`: it is there from an earlier study and takes no time.
  void begin(const std::string& name, bool kept = false);

 private:
  const Options& options_;
  std::size_t parts_;
  std::size_t begun_ = 0;
  std::size_t run_ = 0;  ///< Of those, what was not kept.
  double start_;         ///< s.
};

/// The bar alone; `done` parts of `all`.
std::string progressBar(std::size_t done, std::size_t all);

}  // namespace sluice::evaluate
