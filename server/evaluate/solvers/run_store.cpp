#include "solvers/run_store.h"

#include <limits>

#include "sluice/core/input_error.h"

namespace sluice::evaluate {

namespace {

Value toValue(const Json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number_integer()) return json.get<std::int64_t>();
  if (json.is_number()) return json.get<double>();
  // Numbers that are not finite are written as null.
  return json.is_string() ? Value(json.get<std::string>()) : Value(std::numeric_limits<double>::quiet_NaN());
}

Row toRow(const Json& json) {
  Row row;
  for (const auto& [key, value] : json.items()) row.set(key, toValue(value));
  return row;
}

}  // namespace

RunStore::RunStore(const std::filesystem::path& file, bool resume) : file_(file) {
  if (file_.empty()) return;
  if (resume) read();
  // Whole lines alone, whatever was there.
  std::ofstream out(file_, std::ios::trunc);
  if (!out) throw core::InputError(file_.string(), "--out", "cannot be written");
  out.close();
  for (const auto& [key, rows] : std::map<std::string, std::vector<Row>>(std::move(runs_))) add(key, rows);
}

void RunStore::read() {
  std::ifstream in(file_);
  for (std::string line; std::getline(in, line);) {
    const Json json = Json::parse(line, nullptr, false);
    if (json.is_discarded() || !json.contains("run") || !json.contains("rows")) continue;
    std::vector<Row> rows;
    for (const Json& row : json["rows"]) rows.push_back(toRow(row));
    runs_[json["run"].get<std::string>()] = std::move(rows);
  }
}

const std::vector<Row>* RunStore::find(const std::string& key) const {
  const auto found = runs_.find(key);
  return found == runs_.end() ? nullptr : &found->second;
}

void RunStore::add(const std::string& key, const std::vector<Row>& rows) {
  runs_[key] = rows;
  if (file_.empty()) return;
  Json json = {{"run", key}, {"rows", Json::array()}};
  for (const Row& row : rows) json["rows"].push_back(toJson(row));
  std::ofstream out(file_, std::ios::app);
  out << json.dump() << "\n";
  out.close();
  if (!out) throw core::InputError(file_.string(), "--out", "cannot be written");
}

}  // namespace sluice::evaluate
