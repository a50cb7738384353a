#include "static_files.h"

#include <gtest/gtest.h>

#include <fstream>

namespace sluice::stream::test {
namespace {

namespace fs = std::filesystem;

struct StaticFilesTest : testing::Test {
  StaticFilesTest() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    base = fs::path(testing::TempDir()) / (std::string("sluice_static_") + test->name());
    fs::remove_all(base);
    write("web/index.html", "<html>");
    write("web/assets/index-Ab3_d-9Z.js", "code");
    write("web/assets/logo.svg", "<svg/>");
    write("web/.secret", "hidden");
    write("web/with space.txt", "text");
    write("outside.txt", "outside");
  }
  ~StaticFilesTest() override { fs::remove_all(base); }

  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((base / name).parent_path());
    std::ofstream(base / name) << text;
  }

  fs::path base;
};

TEST_F(StaticFilesTest, FindsFilesAndTheirTypes) {
  const StaticFiles files(base / "web");
  const auto index = files.find("/");
  ASSERT_TRUE(index);
  EXPECT_EQ(index->path.filename(), "index.html");
  EXPECT_EQ(index->contentType, "text/html; charset=utf-8");
  EXPECT_FALSE(index->immutable);
  EXPECT_EQ(files.find("/assets/logo.svg")->contentType, "image/svg+xml");
  EXPECT_EQ(files.find("/index.html?x=1#y")->path, index->path);
  EXPECT_TRUE(files.find("/with%20space.txt"));
  EXPECT_FALSE(files.find("/missing.html"));
  EXPECT_FALSE(files.find("/assets"));
  EXPECT_FALSE(files.find("/assets/"));
}

TEST_F(StaticFilesTest, OnlyHashedAssetsAreImmutable) {
  const StaticFiles files(base / "web");
  EXPECT_TRUE(files.find("/assets/index-Ab3_d-9Z.js")->immutable);
  EXPECT_FALSE(files.find("/assets/logo.svg")->immutable);
}

TEST_F(StaticFilesTest, EtagChangesWithTheFile) {
  const StaticFiles files(base / "web");
  const std::string before = files.find("/")->etag;
  EXPECT_EQ(files.find("/index.html")->etag, before);
  write("web/index.html", "<html> longer");
  EXPECT_NE(files.find("/")->etag, before);
}

TEST_F(StaticFilesTest, NothingOutsideTheRootIsFound) {
  const StaticFiles files(base / "web");
  fs::create_symlink(base / "outside.txt", base / "web/link.txt");
  for (const std::string target :
       {"/../outside.txt", "/%2e%2e/outside.txt", "/assets/../../outside.txt", "/..%2foutside.txt",
        "/assets/..%5c..%5coutside.txt", "/link.txt", "//outside.txt", "outside.txt", "", "/.secret", "/./index.html",
        "/index.html%00.png", "/%", "/%4", "/%zz", "/assets//logo.svg", "/..", "/%2e%2e%2f%2e%2e%2fetc/passwd",
        "/%252e%252e/outside.txt"}) {
    EXPECT_FALSE(files.find(target)) << target;
  }
  EXPECT_FALSE(files.find((base / "outside.txt").string()));
}

TEST_F(StaticFilesTest, WithoutARootThereIsNoPage) {
  EXPECT_FALSE(StaticFiles({}).find("/"));
  EXPECT_FALSE(StaticFiles(base / "missing").find("/"));
}

}  // namespace
}  // namespace sluice::stream::test
