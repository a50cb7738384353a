// `sluice-server evaluate` as a person runs it, on its smallest parts.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "print_json.h"
#include "program.h"

namespace sluice::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Json = nlohmann::json;

class Evaluate : public testing::Test {
 protected:
  Evaluate() {
    std::string pattern = (std::filesystem::temp_directory_path() / "sluice_evaluate_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = pattern;
  }
  ~Evaluate() override { std::filesystem::remove_all(folder_); }

  Outcome evaluate(std::vector<std::string> arguments) const {
    std::vector<std::string> command = {SLUICE_SERVER_PROGRAM, "evaluate"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    command.insert(command.end(), {"--quick", "--out", folder_.string(), "--json"});
    return runProgram(command);
  }

  static Json lastLine(const Outcome& outcome) {
    const std::string lines = outcome.out.substr(0, outcome.out.find_last_not_of('\n') + 1);
    return Json::parse(lines.substr(lines.rfind('\n') + 1));
  }

  std::filesystem::path folder_;
};

const std::set<std::string> kSmoothingKeys{"shape",
                                           "method",
                                           "is_default",
                                           "strength",
                                           "scale",
                                           "milliseconds_median",
                                           "passes",
                                           "depth_rmse_spacings",
                                           "depth_rmse_unbiased_spacings",
                                           "normal_error_mean_deg",
                                           "normal_error_rms_deg",
                                           "normal_error_p95_deg",
                                           "silhouette_iou",
                                           "hausdorff_px",
                                           "curvature_residual",
                                           "holes",
                                           "flicker"};

TEST_F(Evaluate, SmoothingRowsHaveEveryKeyAndTheDefaultItsError) {
  const Outcome outcome = evaluate({"smoothing", "--only", "sphere"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const Json json = lastLine(outcome);
  int defaults = 0;
  std::set<std::string> methods;
  double raw = 0;
  for (const Json& row : json["rows"]) {
    for (const std::string& key : kSmoothingKeys) EXPECT_TRUE(row.contains(key)) << key;
    EXPECT_EQ(row["shape"], "sphere");
    methods.insert(row["method"]);
    if (row["method"] == "none") {
      EXPECT_EQ(row["milliseconds_median"], 0.0);
      EXPECT_EQ(row["passes"], 0);
      raw = row["normal_error_rms_deg"];  // the first row of its resolution
      EXPECT_GT(raw, 20.0) << "raw splats are bumpy";
    } else {
      EXPECT_GT(row["milliseconds_median"], 0.0);
      EXPECT_GT(row["passes"], 0);
      if (!row["normal_error_rms_deg"].is_null()) {
        EXPECT_LT(row["normal_error_rms_deg"], raw) << row["method"];
      }
    }
    // The binomial filter draws only where it has met no background, and eats the outline.
    if (row["method"] != "binomial") {
      EXPECT_EQ(row["holes"], 0) << row["method"];
      EXPECT_GT(row["silhouette_iou"], 0.8) << row["method"];
    }
    if (!row["is_default"]) continue;
    ++defaults;
    EXPECT_LE(row["normal_error_rms_deg"], 5.0) << "what the project promises of a ball of splats of 0.8 d";
  }
  EXPECT_EQ(defaults, 1);
  EXPECT_THAT(methods, testing::IsSupersetOf({"none", "bilateral", "curvature_flow", "implicit_curvature_flow"}));
  EXPECT_GE(json["files"].size(), 5U);
  for (const Json& file : json["files"]) EXPECT_TRUE(std::filesystem::file_size(file.get<std::string>()) > 0) << file;
}

TEST_F(Evaluate, DefaultKeepsAPlanesNormals) {
  const Outcome outcome = evaluate({"smoothing", "--only", "plane"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  for (const Json& row : lastLine(outcome)["rows"]) {
    if (row["is_default"]) {
      EXPECT_LE(row["normal_error_rms_deg"], 2.5) << "what the project promises of a plane of splats of 0.8 d";
    }
  }
}

TEST_F(Evaluate, FeaturesCompareBothSides) {
  const Outcome outcome = evaluate({"features", "--only", "thickness and refraction"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const Json rows = lastLine(outcome)["rows"];
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_GT(rows[0]["milliseconds_in_use"], 0.0);
  EXPECT_GT(rows[0]["milliseconds_left_out"], 0.0);
  EXPECT_GT(rows[0]["bytes_saved"], 0) << "an opaque liquid needs no buffer of thickness";
}

TEST_F(Evaluate, FeaturesAreInUseOnTheSideThatIsMeasured) {
  const std::vector<std::pair<std::string, std::string>> features{{"foam", "foam"},
                                                                  {"velocity map", "velocity map"},
                                                                  {"shadows on bodies", "body shadow"},
                                                                  {"bodies in a cube map", "cube map"},
                                                                  {"glass", "glass behind"}};
  for (const auto& [feature, pass] : features) {
    const Outcome outcome = evaluate({"features", "--only", feature});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const Json rows = lastLine(outcome)["rows"];
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_THAT(rows[0]["passes"].get<std::string>(), testing::HasSubstr(pass));
    EXPECT_GE(rows[0]["bytes_saved"], 0) << feature;
  }
}

TEST_F(Evaluate, ScalingFitsExponents) {
  const Outcome outcome = evaluate({"scaling", "--only", "pixels"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const Json json = lastLine(outcome);
  std::set<std::string> stages;
  for (const Json& row : json["rows"]) {
    EXPECT_EQ(row["axis"], "pixels");
    EXPECT_TRUE(row["exponent"].is_number());
    stages.insert(row["stage"]);
  }
  EXPECT_THAT(stages, testing::Contains("frame"));
  EXPECT_GE(json["tables"]["scaling_points"].size(), 4U);
}

TEST_F(Evaluate, StabilityFailsWhereACaseDoes) {
  const Outcome outcome = evaluate({"stability", "--only", "smoothing"});
  const Json json = lastLine(outcome);
  bool passed = true;
  std::set<std::string> cases;
  for (const Json& row : json["rows"]) {
    for (const char* key : {"case", "method", "strength", "outcome", "largest", "limit", "passed"}) {
      EXPECT_TRUE(row.contains(key)) << key;
    }
    EXPECT_NE(row["outcome"], "not finite") << row;
    passed = passed && row["passed"];
    cases.insert(row["case"]);
    if (row["case"].get<std::string>().find(" of the bound") != std::string::npos) {
      EXPECT_EQ(row["passed"], true) << row;
    }
  }
  EXPECT_GE(cases.size(), 40U);
  EXPECT_EQ(outcome.exitCode, passed ? 0 : 1);
  EXPECT_EQ(json["failures"].empty(), passed);
}

TEST_F(Evaluate, StabilityTellsEveryOutcomeAndGoesOnWhereItWasCutOff) {
  const Outcome whole = evaluate({"stability", "--only", "tension"});
  ASSERT_EQ(whole.exitCode, 0) << whole.err;
  EXPECT_THAT(whole.err, HasSubstr("[#####"));
  const Json rows = lastLine(whole)["rows"];
  for (const Json& row : rows) {
    EXPECT_THAT((std::set<std::string>{"stable", "recovered", "stopped"}), testing::Contains(row["outcome"])) << row;
  }

  // As if it had been cut off in its fourth run, and with a mark on the first.
  const std::filesystem::path file = folder_ / "stability_runs.jsonl";
  std::vector<std::string> lines;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  ASSERT_GT(lines.size(), 4U);
  Json first = Json::parse(lines[0]);
  first["rows"][0]["message"] = "marked";
  std::ofstream(file, std::ios::trunc) << first.dump() << "\n" << lines[1] << "\n" << lines[2] << "\n{\"run\":\"full";

  const Outcome resumed = evaluate({"stability", "--only", "tension", "--resume"});
  ASSERT_EQ(resumed.exitCode, 0) << resumed.err;
  const Json again = lastLine(resumed)["rows"];
  ASSERT_EQ(again.size(), rows.size());
  EXPECT_EQ(again[0]["message"], "marked") << "what is done is not done again";
  for (std::size_t i = 1; i < rows.size(); ++i) EXPECT_EQ(again[i], rows[i]);
}

TEST_F(Evaluate, UnknownNamesAreRefused) {
  const Outcome study = evaluate({"smothing"});
  EXPECT_EQ(study.exitCode, 2);
  EXPECT_THAT(study.err, AllOf(HasSubstr("smothing"), HasSubstr("smoothing, solvers, stability")));
  const Outcome part = evaluate({"stability", "--only", "smothing"});
  EXPECT_EQ(part.exitCode, 2);
  EXPECT_THAT(part.err, AllOf(HasSubstr("--only"), HasSubstr("smoothing")));
  EXPECT_EQ(evaluate({"smoothing", "--only", "particles", "--particles", "/nowhere.ply"}).exitCode, 2);
  EXPECT_EQ(evaluate({"smoothing", "--set", "look.smoothing.tim=1"}).exitCode, 2);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

}  // namespace
}  // namespace sluice::test
