#include "sluice/core/whole_file.h"

#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sluice/core/input_error.h"

namespace sluice::core {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class WholeFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("sluice_whole_file_") + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    writeWholeFile(folder_ / name, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }

  std::string writeError(const std::string& name) const {
    try {
      write(name, "text");
    } catch (const InputError& error) {
      return error.what();
    }
    ADD_FAILURE() << name << " was written";
    return {};
  }

  std::string read(const std::string& name) const {
    std::ifstream stream(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  std::string readError(const std::string& name, std::uintmax_t mostBytes = 100) const {
    try {
      readWholeFile(folder_ / name, mostBytes);
    } catch (const InputError& error) {
      return error.what();
    }
    ADD_FAILURE() << name << " was read";
    return {};
  }

  fs::path folder_;
};

TEST_F(WholeFile, HoldsWhatWasWrittenLast) {
  for (const char* text : {"a longer text", "short", ""}) {
    write("a", text);
    EXPECT_EQ(read("a"), text);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(WholeFile, NamesPathAndReason) {
  EXPECT_THAT(writeError("none/a"), HasSubstr((folder_ / "none/a").string() + ": cannot be written: No such file"));
  fs::create_directory(folder_ / "b");
  EXPECT_THAT(writeError("b"), HasSubstr("b: cannot be written: Is a directory"));
}

TEST_F(WholeFile, KeepsTheOldFileWhenTheDiskIsFull) {
  write("a", "old");
  // What is written to /dev/full finds no space left.
  fs::create_symlink("/dev/full", folder_ / "a.part");
  EXPECT_THAT(writeError("a"), HasSubstr("a: cannot be written: No space left"));
  EXPECT_EQ(read("a"), "old");
  EXPECT_FALSE(fs::exists(fs::symlink_status(folder_ / "a.part")));
}

TEST_F(WholeFile, IsReadAsItWasWritten) {
  const std::vector<std::uint8_t> bytes{0, 255, '\n', '\r', 26};
  writeWholeFile(folder_ / "a", bytes);
  EXPECT_EQ(readWholeFile(folder_ / "a", 5), bytes);
  write("empty", "");
  EXPECT_TRUE(readWholeFile(folder_ / "empty", 0).empty());
}

TEST_F(WholeFile, ThatCannotBeReadIsNamed) {
  EXPECT_THAT(readError("none"), HasSubstr((folder_ / "none").string() + ": no such file"));
  fs::create_directory(folder_ / "b");
  EXPECT_THAT(readError("b"), HasSubstr("b: is not a file"));
  write("large", "12345");
  EXPECT_THAT(readError("large", 4), HasSubstr("large: has 5 bytes; allowed are at most 4"));
}

}  // namespace
}  // namespace sluice::core
