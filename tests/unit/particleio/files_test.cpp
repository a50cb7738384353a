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

TEST_F(Files, AreWrittenInTheFormatThatIsGiven) {
  writeParticleFile(folder_ / "a.bgeo", someParticles(), Format::BgeoGzip);
  std::ifstream file(folder_ / "a.bgeo", std::ios::binary);
  EXPECT_EQ(file.get(), 0x1f) << "gzip's signature";
  EXPECT_EQ(readParticleFile(folder_ / "a.bgeo").pressures, someParticles().pressures);
}

/// The message of the InputError that writing throws.
std::string writeError(const fs::path& file) {
  try {
    writeParticleFile(file, someParticles());
  } catch (const core::InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << file << " was written";
  return {};
}

TEST_F(Files, CannotBeWrittenWhereThereIsNoFolder) {
  EXPECT_THAT(writeError(folder_ / "none" / "a.ply"), HasSubstr("none/a.ply: cannot be written: No such file"));
}

TEST_F(Files, KeepWhatWasThereWhenTheDiskIsFull) {
  const fs::path file = folder_ / "a.ply";
  writeParticleFile(file, someParticles());
  const auto size = fs::file_size(file);
  // What is written to /dev/full finds no space left.
  fs::create_symlink("/dev/full", folder_ / "a.ply.part");
  EXPECT_THAT(writeError(file), HasSubstr("a.ply: cannot be written: No space left"));
  EXPECT_EQ(fs::file_size(file), size);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1) << "no half-written file stays";
}

}  // namespace
}  // namespace sluice::particleio::test
