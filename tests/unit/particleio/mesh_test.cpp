#include "sluice/particleio/mesh_file.h"

#include <cstdlib>
#include <filesystem>

#include <gmock/gmock.h>
#include <Eigen/Geometry>

#include "support.h"

namespace sluice::particleio::test {
namespace {

using namespace std::string_literals;
using testing::ElementsAre;
using testing::HasSubstr;

using Triangle = std::array<std::uint32_t, 3>;

TriangleMesh decodeText(std::string_view text, MeshFormat format) { return decodeMesh(bytesOf(text), format, "file"); }

std::string errorOf(std::string_view text, MeshFormat format) {
  try {
    decodeText(text, format);
  } catch (const core::InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "was decoded";
  return {};
}

const std::string kObjVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0 0.5 0.5 0.5\r\nv\t0 1  0\n";

TEST(ObjMesh, ReadsEveryFormOfACorner) {
  for (const char* face : {"f 1 2 3", "f 1/1 2/7 3/9", "f -4 -3 -2", "  f  1\t2 3  # a comment\r", "f -4/-1 2/5 -2"}) {
    const TriangleMesh mesh = decodeText(kObjVertices + "usemtl x\nvt 0 0\n" + face + "\n", MeshFormat::Obj);
    EXPECT_EQ(mesh.positions.size(), 4U) << face;
    EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2})) << face;
    EXPECT_TRUE(mesh.normals.empty()) << face;
  }
  for (const char* face : {"f 1//1 2//1 3//1", "f 1/1/1 2/2/1 3/3/-1"}) {
    const TriangleMesh mesh = decodeText(kObjVertices + "vn 0 0 2\n" + face, MeshFormat::Obj);
    EXPECT_EQ(mesh.positions.size(), 3U) << face;
    EXPECT_THAT(mesh.normals, testing::Each(Eigen::Vector3f(0, 0, 1))) << face;
  }
}

TEST(ObjMesh, FansPolygonsAboutTheirFirstCorner) {
  EXPECT_THAT(decodeText(kObjVertices + "f 2 3 4 1\n", MeshFormat::Obj).triangles,
              ElementsAre(Triangle{1, 2, 3}, Triangle{1, 3, 0}));
}

TEST(ObjMesh, MakesVerticesOfSharpEdgesOfTheirOwn) {
  const TriangleMesh mesh =
      decodeText(kObjVertices + "vn 0 0 1\nvn 0 1 0\nf 1//1 2//1 3//1\nf 1//2 3//2 4//2\n", MeshFormat::Obj);
  ASSERT_EQ(mesh.positions.size(), 6U);
  EXPECT_EQ(mesh.positions[0], mesh.positions[3]);
  EXPECT_NE(mesh.normals[0], mesh.normals[3]);
}

TEST(ObjMesh, LeavesNormalsOutWhereAFaceLacksThem) {
  const TriangleMesh mesh = decodeText(kObjVertices + "vn 0 0 1\nf 1//1 2//1 3//1\nf 1 3 4\n", MeshFormat::Obj);
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_EQ(mesh.triangles.size(), 2U);
}

TEST(ObjMesh, NamesTheLineOfAMistake) {
  const auto error = [](const std::string& rest) { return errorOf(kObjVertices + rest, MeshFormat::Obj); };
  EXPECT_EQ(error("f 1 2 5\n"), "file:5: index 5 is outside the 4 vertices so far");
  EXPECT_EQ(error("f 1 2 -5\n"), "file:5: index -5 is outside the 4 vertices so far");
  EXPECT_THAT(error("\nf 0 1 2\n"), HasSubstr("file:6: index 0"));
  EXPECT_EQ(error("f 1//1 2//1 3//1\n"), "file:5: index 1 is outside the 0 normals so far");
  EXPECT_THAT(error("f 1 2\n"), HasSubstr("this one has 2"));
  EXPECT_THAT(error("f a b c\n"), HasSubstr("file:5: \"a\" is not a corner"));
  EXPECT_THAT(error("f 99999999999999999999 1 2\n"), HasSubstr("is not a corner"));
  EXPECT_THAT(error("v 1 2\n"), HasSubstr("file:5: a vertex needs three numbers"));
  EXPECT_THAT(error("v nan 0 0\n"), HasSubstr("file:5: the vertex is not finite"));
  EXPECT_THAT(error("v 1e300 0 0\n"), HasSubstr("not finite"));
  EXPECT_THAT(error("vn 0 inf 0\n"), HasSubstr("the normal is not finite"));
  EXPECT_EQ(error(""), "file: has no faces");
}

std::string plyHead(const std::string& vertices, const std::string& faces, bool normals = false) {
  return "ply\nformat ascii 1.0\nelement vertex " + vertices + "\nproperty float x\nproperty float y\n" +
         "property float z\n" +
         (normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "property uchar red\n") +
         "element face " + faces + "\nproperty list uchar int vertex_indices\nend_header\n";
}

TEST(PlyMesh, ReadsAscii) {
  const TriangleMesh mesh =
      decodeText(plyHead("4", "1") + "0 0 0 9\n1 0 0 9\n1 1 0 9\n0 1 0 9\n4 0 1 2 3\n", MeshFormat::Ply);
  EXPECT_EQ(mesh.positions[2], Eigen::Vector3f(1, 1, 0));
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
}

TEST(PlyMesh, ReadsNormals) {
  const TriangleMesh mesh =
      decodeText(plyHead("3", "1", true) + "0 0 0 0 0 3\n1 0 0 0 2 0\n1 1 0 0 0 0\n3 0 1 2\n", MeshFormat::Ply);
  EXPECT_THAT(mesh.normals,
              ElementsAre(Eigen::Vector3f::UnitZ(), Eigen::Vector3f::UnitY(), Eigen::Vector3f::Zero().eval()));
}

TEST(PlyMesh, ReadsBothByteOrdersAndFacesBeforeVertices) {
  const auto head = [](const char* order) {
    return "ply\nformat binary_"s + order +
           "_endian 1.0\nelement face 1\nproperty uchar flag\nproperty list uchar ushort vertex_index\n"
           "element vertex 3\nproperty float x\nproperty short y\nproperty char z\nend_header\n";
  };
  const std::string big =
      "\x07\x03\x00\x00\x00\x01\x00\x02"s
      "\x3f\x80\x00\x00\x00\x02\x03"s
      "\x40\x00\x00\x00\xff\xff\x04"s
      "\x40\x40\x00\x00\x00\x05\x06"s;
  const std::string little =
      "\x07\x03\x00\x00\x01\x00\x02\x00"s
      "\x00\x00\x80\x3f\x02\x00\x03"s
      "\x00\x00\x00\x40\xff\xff\x04"s
      "\x00\x00\x40\x40\x05\x00\x06"s;
  for (const std::string& file : {head("big") + big, head("little") + little}) {
    const TriangleMesh mesh = decodeText(file, MeshFormat::Ply);
    EXPECT_THAT(mesh.positions,
                ElementsAre(Eigen::Vector3f(1, 2, 3), Eigen::Vector3f(2, -1, 4), Eigen::Vector3f(3, 5, 6)));
    EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
  }
}

TEST(PlyMesh, RefusesWhatMakesNoSense) {
  const std::string vertices = "0 0 0 9\n1 0 0 9\n1 1 0 9\n";
  const auto error = [&](const std::string& text) { return errorOf(text, MeshFormat::Ply); };
  EXPECT_EQ(error(plyHead("3", "1") + vertices + "3 0 1 3\n"), "file: a face names vertex 3; there are 3");
  EXPECT_THAT(error(plyHead("3", "1") + vertices + "3 0 1 -1\n"), HasSubstr("not a number of a vertex"));
  EXPECT_THAT(error(plyHead("3", "1") + vertices + "3 0 1 0.5\n"), HasSubstr("not a number of a vertex"));
  EXPECT_THAT(error(plyHead("3", "1") + vertices + "3 0 1 nan\n"), HasSubstr("not a number of a vertex"));
  EXPECT_THAT(error(plyHead("3", "1") + vertices + "2 0 1\n"), HasSubstr("three corners"));
  EXPECT_THAT(error(plyHead("3", "1") + "0 0 0 9\n1 nan 0 9\n1 1 0 9\n3 0 1 2\n"),
              HasSubstr("y of vertex 1 is not finite"));
  EXPECT_THAT(error(plyHead("3", "0") + vertices), HasSubstr("has no faces"));
  EXPECT_THAT(error("ply\nformat ascii 1.0\nelement face 0\nproperty list uchar int a\nend_header\n"),
              HasSubstr("vertex_indices"));
}

TEST(PlyMesh, TakesNoMemoryForCountsThatLie) {
  const auto error = [&](const std::string& text) { return errorOf(text, MeshFormat::Ply); };
  EXPECT_THAT(error(plyHead("18446744073709551615", "1") + "0 0 0 9\n"), HasSubstr("cut off"));
  EXPECT_THAT(error(plyHead("1", "18446744073709551615") + "0 0 0 9\n3 0 0 0\n"), HasSubstr("cut off"));
  EXPECT_THAT(error(plyHead("1", "1") + "0 0 0 9\n1e15 0 0 0\n"), HasSubstr("cut off"));
}

/// What is cut off or altered gives a mesh whose indices hold, or one InputError in one line.
void expectMeshOrInputError(const Bytes& bytes, MeshFormat format) {
  try {
    const TriangleMesh mesh = decodeMesh(bytes, format, "file");
    for (const Eigen::Vector3f& position : mesh.positions) ASSERT_TRUE(position.allFinite());
    for (const Triangle& triangle : mesh.triangles) {
      for (const std::uint32_t index : triangle) ASSERT_LT(index, mesh.positions.size());
    }
  } catch (const core::InputError& error) {
    const std::string message = error.what();
    ASSERT_TRUE(message.starts_with("file")) << message;
    ASSERT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(MeshHostile, CutOffOrAlteredAnywhere) {
  const std::string obj = kObjVertices + "vn 0 0 1\nf 1//1 2//1 3//1 4//1\nf -1//-1 1//1 2//1\n";
  const std::string ply = plyHead("3", "1", true) + "0 0 0 0 0 3\n1 0 0 0 2 0\n1 1 0 0 0 0\n3 0 1 2\n";
  for (const auto& [text, format] : {std::pair(obj, MeshFormat::Obj), std::pair(ply, MeshFormat::Ply)}) {
    const Bytes whole = bytesOf(text);
    for (std::size_t i = 0; i < whole.size(); ++i) {
      expectMeshOrInputError({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(i)}, format);
      for (const int value : {0x00, 0x0a, 0x7f, 0x80, 0xff, 0x39, 0x2d, 0x2f}) {
        Bytes changed = whole;
        changed[i] = static_cast<std::uint8_t>(value);
        expectMeshOrInputError(changed, format);
      }
    }
  }
}

TEST(MeshFile, IsKnownByItsEnding) {
  EXPECT_EQ(meshFormatOf("a/Dragon.OBJ"), MeshFormat::Obj);
  EXPECT_EQ(meshFormatOf("bunny.ply"), MeshFormat::Ply);
  EXPECT_EQ(meshFormatOf("bunny.stl"), std::nullopt);
  EXPECT_THROW(readMeshFile("no_such_file.obj"), core::InputError);
  EXPECT_THROW(readMeshFile("bunny.stl"), core::InputError);
}

TEST(MeshFile, ReadsMeshesOfOtherPrograms) {
  const char* data = std::getenv("SLUICE_TEST_DATA");
  if (data == nullptr) GTEST_SKIP() << "SLUICE_TEST_DATA names no folder with meshes from other programs";
  const std::filesystem::path folder = std::filesystem::path(data) / "meshes";
  const TriangleMesh dragon = readMeshFile(folder / "dragon_50k.obj");
  EXPECT_EQ(dragon.positions.size(), 25007U);
  EXPECT_EQ(dragon.triangles.size(), 50000U);
  EXPECT_TRUE(dragon.normals.empty());
  const TriangleMesh torus = readMeshFile(folder / "torus.obj");
  EXPECT_EQ(torus.triangles.size(), 800U);
  ASSERT_EQ(torus.normals.size(), torus.positions.size());
  for (const Eigen::Vector3f& normal : torus.normals) EXPECT_NEAR(normal.norm(), 1, 1e-4);
}

}  // namespace
}  // namespace sluice::particleio::test
