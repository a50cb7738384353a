#include "sluice/evaluate/report.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "sluice/core/check.h"
#include "sluice/core/input_error.h"

namespace sluice::evaluate {

namespace {

/// The shortest text that reads back as the same number.
std::string exactText(double value) {
  std::array<char, 32> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  SLUICE_CHECK(error == std::errc());
  return {buffer.data(), end};
}

std::string csvText(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return std::isfinite(*number) ? exactText(*number) : "";
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return std::to_string(*whole);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  const std::string& text = std::get<std::string>(value);
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  quoted += '"';
  return quoted;
}

std::vector<std::string> keysOf(const Table& table) {
  std::vector<std::string> keys;
  for (const Row& row : table.rows) {
    for (const auto& [key, value] : row.cells()) {
      if (std::ranges::find(keys, key) == keys.end()) keys.push_back(key);
    }
  }
  return keys;
}

std::filesystem::path writeText(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw core::InputError(file.string(), "--out", "cannot be written");
  return file;
}

}  // namespace

Row::Row(std::initializer_list<std::pair<std::string, Value>> cells) {
  for (const auto& [key, value] : cells) set(key, value);
}

void Row::set(std::string_view key, Value value) {
  const auto found = std::ranges::find(cells_, key, &std::pair<std::string, Value>::first);
  if (found != cells_.end()) {
    found->second = std::move(value);
  } else {
    cells_.emplace_back(key, std::move(value));
  }
}

void Row::erase(std::string_view key) {
  std::erase_if(cells_, [&](const auto& cell) { return cell.first == key; });
}

const Value* Row::find(std::string_view key) const {
  const auto found = std::ranges::find(cells_, key, &std::pair<std::string, Value>::first);
  return found == cells_.end() ? nullptr : &found->second;
}

const Value& Row::at(std::string_view key) const {
  const Value* const value = find(key);
  SLUICE_CHECK(value != nullptr);
  return *value;
}

double Row::number(std::string_view key) const {
  const Value& value = at(key);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  SLUICE_CHECK(std::holds_alternative<double>(value));
  return std::get<double>(value);
}

const std::string& Row::text(std::string_view key) const {
  const Value& value = at(key);
  SLUICE_CHECK(std::holds_alternative<std::string>(value));
  return std::get<std::string>(value);
}

bool Row::flag(std::string_view key) const {
  const Value& value = at(key);
  SLUICE_CHECK(std::holds_alternative<bool>(value));
  return std::get<bool>(value);
}

Json toJson(const Row& row) {
  Json json = Json::object();
  for (const auto& [key, value] : row.cells()) {
    std::visit([&, &name = key](const auto& v) { json[name] = v; }, value);  // the library writes NaN and ∞ as null
  }
  return json;
}

Json toJson(const Table& table) {
  Json json = Json::array();
  for (const Row& row : table.rows) json.push_back(toJson(row));
  return json;
}

std::string toCsv(const Table& table) {
  const std::vector<std::string> keys = keysOf(table);
  std::string text;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (i > 0) text += ",";
    text += csvText(keys[i]);
  }
  text += "\n";
  for (const Row& row : table.rows) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
      if (i > 0) text += ",";
      if (const Value* const value = row.find(keys[i])) text += csvText(*value);
    }
    text += "\n";
  }
  return text;
}

std::string shortText(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) {
    if (!std::isfinite(*number)) return "–";
    std::array<char, 32> buffer{};
    // Three digits; from a thousand on all before the point, which %g would turn into a power of ten.
    std::snprintf(buffer.data(), buffer.size(), std::abs(*number) >= 1000 ? "%.0f" : "%.3g", *number);
    return buffer.data();
  }
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return std::to_string(*whole);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "yes" : "no";
  return std::get<std::string>(value);
}

std::string toMarkdown(const std::vector<Row>& rows, const std::vector<std::pair<std::string, std::string>>& columns) {
  std::string text = "|";
  for (const auto& [key, heading] : columns) text += " " + heading + " |";
  text += "\n|";
  for (const auto& [key, heading] : columns) {
    const Value* const first = rows.empty() ? nullptr : rows.front().find(key);
    const bool isText = first == nullptr || std::holds_alternative<std::string>(*first);
    text += isText ? "---|" : "---:|";
  }
  text += "\n";
  for (const Row& row : rows) {
    text += "|";
    for (const auto& [key, heading] : columns) {
      const Value* const value = row.find(key);
      text += " ";
      if (value != nullptr) text += shortText(*value);
      text += " |";
    }
    text += "\n";
  }
  return text;
}

std::vector<std::filesystem::path> writeReport(const Report& report, const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw core::InputError(folder.string(), "--out", "cannot be made: " + error.message());
  std::vector<std::filesystem::path> files;
  for (const Table& table : report.tables) {
    files.push_back(writeText(folder / (table.name + ".csv"), toCsv(table)));
    files.push_back(writeText(folder / (table.name + ".json"), toJson(table).dump(1) + "\n"));
  }
  for (const Document& document : report.documents) {
    files.push_back(writeText(folder / document.fileName, document.text));
  }
  return files;
}

Json toJson(const Report& report, const std::vector<std::filesystem::path>& files) {
  Json json = {{"rows", Json::array()},
               {"tables", Json::object()},
               {"notes", report.notes},
               {"failures", report.failures},
               {"files", Json::array()}};
  for (std::size_t i = 0; i < report.tables.size(); ++i) {
    if (i == 0) {
      json["rows"] = toJson(report.tables[i]);
    } else {
      json["tables"][report.tables[i].name] = toJson(report.tables[i]);
    }
  }
  for (const std::filesystem::path& file : files) json["files"].push_back(file.string());
  return json;
}

}  // namespace sluice::evaluate
