#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

namespace sluice::evaluate {

/// One figure of a study.
using Value = std::variant<double, std::int64_t, bool, std::string>;

/// One line of a table: keys in the order in which they were set, each with its value.
class Row {
 public:
  Row() = default;
  Row(std::initializer_list<std::pair<std::string, Value>> cells);

  /// Sets a value, at the end where the key is new.
  void set(std::string_view key, Value value);

  void erase(std::string_view key);

  /// Null where there is no such key.
  const Value* find(std::string_view key) const;

  // The value of a key that is there and of that type.
  double number(std::string_view key) const;  ///< A double or an integer.
  const std::string& text(std::string_view key) const;
  bool flag(std::string_view key) const;

  const std::vector<std::pair<std::string, Value>>& cells() const { return cells_; }

 private:
  const Value& at(std::string_view key) const;

  std::vector<std::pair<std::string, Value>> cells_;
};

struct Table {
  std::string name;
  std::vector<Row> rows;
};

/// A text beside the tables: a plot, a page.
struct Document {
  std::string fileName;
  std::string text;
};

/// What a study found.
struct Report {
  std::vector<Table> tables;          ///< The first is the study's own; the others stand beside it.
  std::vector<Document> documents;    ///< Plots and pages.
  std::vector<std::string> notes;     ///< What was left out, and why; what a reader has to know.
  std::vector<std::string> failures;  ///< Cases that must hold and did not.
};

using Json = nlohmann::ordered_json;

/// A flat object; a number that is not finite becomes null.
Json toJson(const Row& row);
Json toJson(const Table& table);

/// Comma-separated values (RFC 4180) under a header of all keys of any row; a cell that a row lacks, or a number that
/// is not finite, is empty.
std::string toCsv(const Table& table);

/// A table in Markdown of the columns named, which every row has: key and heading. Numbers are shown to three digits.
std::string toMarkdown(const std::vector<Row>& rows, const std::vector<std::pair<std::string, std::string>>& columns);

/// For people: three significant digits, whole numbers in full, "yes" and "no".
std::string shortText(const Value& value);

/// Writes NAME.csv and NAME.json of every table, and the documents. Returns the files' paths in that order. Throws
/// core::InputError that names --out where the folder or a file cannot be written.
std::vector<std::filesystem::path> writeReport(const Report& report, const std::filesystem::path& folder);

/// {"rows": the first table's rows, "tables": {the others' names: their rows}, "notes": […], "failures": […],
/// "files": […]}
Json toJson(const Report& report, const std::vector<std::filesystem::path>& files);

}  // namespace sluice::evaluate
