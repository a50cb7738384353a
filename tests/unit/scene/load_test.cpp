#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include "support.h"

namespace sluice::scene::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Load : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("sluice_load_") + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  fs::path folder_;
};

TEST_F(Load, ReadsAFile) {
  EXPECT_EQ(load(write("a.textproto", kSmallScene)).SerializeAsString(), smallScene().SerializeAsString());
}

TEST_F(Load, NamesTheFileInErrors) {
  const fs::path file = write("bad.textproto", "\nwibble: 1\n");
  EXPECT_EQ(inputError([&] { load(file); }).where(), file.string() + ":2:1");
}

TEST_F(Load, RefusesWhatIsNotAFile) {
  EXPECT_THAT(inputError([&] { load(folder_ / "none.textproto"); }).what(), HasSubstr("none.textproto: no such file"));
  EXPECT_THAT(inputError([&] { load(folder_); }).what(), HasSubstr("is not a file"));
}

TEST_F(Load, RefusesFilesTooLargeToBeAScene) {
  const fs::path file = write("large.textproto", std::string((4U << 20U) + 1, '#'));
  EXPECT_THAT(inputError([&] { load(file); }).problem(), HasSubstr("at most 4194304"));
}

TEST_F(Load, TakesRelativePathsFromTheScenesFolder) {
  const fs::path file = write("play.textproto", "particle_file { path: \"cache/frame_####.bgeo\" }");
  EXPECT_EQ(load(file).particle_file().path(), (folder_ / "cache/frame_####.bgeo").string());
  const fs::path absolute = write("play2.textproto", "particle_file { path: \"/cache/frame.bgeo\" }");
  EXPECT_EQ(load(absolute).particle_file().path(), "/cache/frame.bgeo");
  const v1::Scene bodies = load(write("bodies.textproto",
                                      "column_and_sheet {}\nbodies { sphere {} }\nbodies { mesh { path: \"a.obj\" } }\n"
                                      "bodies { mesh { path: \"/b.ply\" } }\n"
                                      "background { environment_map { path: \"sky/noon.hdr\" } }"));
  EXPECT_EQ(bodies.bodies(1).mesh().path(), (folder_ / "a.obj").string());
  EXPECT_EQ(bodies.bodies(2).mesh().path(), "/b.ply");
  const v1::Scene fluids = load(write("fluids.textproto",
                                      "simulation { container { min {} max { x: 1 y: 1 z: 1 } }\n"
                                      "fluids { meshes { path: \"a.obj\" } meshes { path: \"/b.ply\" } } }"));
  EXPECT_EQ(fluids.simulation().fluids(0).meshes(0).path(), (folder_ / "a.obj").string());
  EXPECT_EQ(fluids.simulation().fluids(0).meshes(1).path(), "/b.ply");
  EXPECT_EQ(bodies.background().environment_map().path(), (folder_ / "sky/noon.hdr").string());
}

}  // namespace
}  // namespace sluice::scene::test
