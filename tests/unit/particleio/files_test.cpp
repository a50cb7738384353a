#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include "support.h"

namespace sluice::particleio::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Files : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("sluice_particleio_") + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  static std::string readError(const fs::path& file) {
    try {
      readParticleFile(file);
    } catch (const core::InputError& error) {
      return error.what();
    }
    return {};
  }

  fs::path folder_;
};

TEST_F(Files, AreReadBackAsWritten) {
  for (const char* name : {"a.bgeo", "a.BGEO.GZ", "a.vtk", "a.ply", "a.csv"}) {
    writeParticleFile(folder_ / name, someParticles());
    EXPECT_EQ(readParticleFile(folder_ / name).velocities, someParticles().velocities) << name;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 5) << "no half-written files stay";
}

TEST_F(Files, SayWhatIsWrongWithTheirName) {
  EXPECT_THAT(readError(folder_ / "none.ply"), HasSubstr("none.ply: no such file"));
  EXPECT_THAT(readError(folder_ / "none.docx"), HasSubstr("known endings are .bgeo, .bgeo.gz, .vtk"));
  fs::create_directory(folder_ / "folder.vtk");
  EXPECT_THAT(readError(folder_ / "folder.vtk"), HasSubstr("is not a file"));
  EXPECT_THROW(writeParticleFile(folder_ / "a.docx", someParticles()), core::InputError);
}

TEST_F(Files, AreRefusedWhenEmpty) {
  for (const char* name : {"a.bgeo", "a.vtk", "a.ply"}) {
    std::ofstream(folder_ / name).close();
    EXPECT_THAT(readError(folder_ / name), HasSubstr(name)) << name;
  }
}

TEST_F(Files, CannotBeWrittenWhereThereIsNoFolder) {
  EXPECT_THROW(writeParticleFile(folder_ / "none" / "a.ply", someParticles()), core::EnvironmentError);
}

}  // namespace
}  // namespace sluice::particleio::test
