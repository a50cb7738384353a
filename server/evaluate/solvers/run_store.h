#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "sluice/evaluate/report.h"

namespace sluice::evaluate {

/// Rows of the runs that are done, a line of JSON for each run in a file, so that a study that is cut off can go on.
class RunStore {
 public:
  /// Keeps nothing where `file` is empty. Reads what is there where `resume`, and starts anew otherwise; a last line
  /// that was cut off counts as not written. Throws core::InputError where the file cannot be written.
  RunStore(const std::filesystem::path& file, bool resume);

  /// Rows of the run of that name; null where it is still to be done.
  const std::vector<Row>* find(const std::string& key) const;

  void add(const std::string& key, const std::vector<Row>& rows);

 private:
  void read();

  std::filesystem::path file_;
  std::map<std::string, std::vector<Row>> runs_;
};

}  // namespace sluice::evaluate
