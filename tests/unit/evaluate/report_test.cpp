#include "sluice/evaluate/report.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sluice/core/input_error.h"

namespace sluice::evaluate {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Table sample() {
  return {"sample",
          {{{"shape", std::string("ball")}, {"scale", 0.5}, {"holes", std::int64_t{3}}, {"is_default", true}},
           {{"shape", std::string("a \"b\", c")}, {"extra", std::numeric_limits<double>::infinity()}}}};
}

TEST(Report, RowKeepsTheOrderOfItsKeys) {
  Row row{{"b", 1.0}, {"a", 2.0}};
  row.set("c", 3.0);
  row.set("b", 4.0);
  std::vector<std::string> keys;
  for (const auto& [key, value] : row.cells()) keys.push_back(key);
  EXPECT_THAT(keys, ElementsAre("b", "a", "c"));
  EXPECT_EQ(row.number("b"), 4.0);
  EXPECT_EQ(row.find("d"), nullptr);
}

TEST(Report, CsvHasEveryKeyAndQuotesWhatItMust) {
  EXPECT_EQ(toCsv(sample()),
            "shape,scale,holes,is_default,extra\n"
            "ball,0.5,3,true,\n"
            "\"a \"\"b\"\", c\",,,,\n");
}

TEST(Report, CsvNumbersReadBackTheSame) {
  const double value = 0.1 + 0.2;
  const std::string text = toCsv({"t", {{{"x", value}}}});
  EXPECT_EQ(std::strtod(text.c_str() + 2, nullptr), value);
}

TEST(Report, JsonKeepsTypesAndTurnsWhatIsNotFiniteIntoNull) {
  const Json json = Json::parse(toJson(sample()).dump());
  EXPECT_EQ(json[0]["scale"], 0.5);
  EXPECT_TRUE(json[0]["holes"].is_number_integer());
  EXPECT_EQ(json[0]["is_default"], true);
  EXPECT_TRUE(json[1]["extra"].is_null());
}

TEST(Report, FirstTableGivesTheRows) {
  Report report;
  report.tables = {sample(), {"beside", {{{"x", 1.0}}}}};
  report.notes = {"a note"};
  const Json json = toJson(report, {"out/sample.csv"});
  EXPECT_EQ(json["rows"].size(), 2U);
  EXPECT_EQ(json["tables"]["beside"][0]["x"], 1.0);
  EXPECT_EQ(json["notes"][0], "a note");
  EXPECT_EQ(json["files"][0], "out/sample.csv");
}

TEST(Report, MarkdownShowsThreeDigits) {
  const std::string text =
      toMarkdown({{{"name", std::string("x")}, {"value", 1.23456}}}, {{"name", "who"}, {"value", "how much"}});
  EXPECT_EQ(text, "| who | how much |\n|---|---:|\n| x | 1.23 |\n");
  EXPECT_EQ(shortText(12345.6), "12346");
}

TEST(Report, WritesItsFiles) {
  const auto folder = std::filesystem::temp_directory_path() / ("sluice_report_" + std::to_string(::getpid()));
  Report report;
  report.tables = {sample()};
  report.documents = {{"page.md", "# A page\n"}};
  const auto files = writeReport(report, folder / "new");
  ASSERT_EQ(files.size(), 3U);
  std::ifstream page(files[2]);
  std::ostringstream text;
  text << page.rdbuf();
  EXPECT_EQ(text.str(), "# A page\n");
  std::filesystem::remove_all(folder);
}

TEST(Report, RefusesAFolderThatCannotBe) {
  try {
    writeReport({}, "/dev/null/inside");
    FAIL() << "nothing was thrown";
  } catch (const core::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("--out"));
    EXPECT_THAT(error.what(), HasSubstr("/dev/null/inside"));
  }
}

}  // namespace
}  // namespace sluice::evaluate
