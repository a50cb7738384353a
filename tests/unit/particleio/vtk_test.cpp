#include <gmock/gmock.h>

#include "support.h"

namespace sluice::particleio::test {
namespace {

using testing::HasSubstr;

const std::string kHead = "# vtk DataFile Version 3.0\nparticles\nASCII\nDATASET POLYDATA\n";

TEST(Vtk, ReadsAsciiWithAttributesOfEveryKind) {
  const ParticleFileData particles = decodeString(kHead +
                                                      "POINTS 2 float\n0 1 2 3 4\n5\n"
                                                      "VERTICES 2 4\n1 0\n1 1\n"
                                                      "POINT_DATA 2\n"
                                                      "SCALARS density double\nLOOKUP_TABLE default\n1000 999.5\n"
                                                      "NORMALS n float\n0 0 1 0 0 1\n"
                                                      "VECTORS v float\n1 2 3 4 5 6\n"
                                                      "FIELD extra 2\n"
                                                      "pressure 1 2 float\n7 8\n"
                                                      "ID 1 2 int\n3 9\n",
                                                  Format::Vtk);
  EXPECT_EQ(particles.positions[1], Eigen::Vector3f(3, 4, 5));
  EXPECT_EQ(particles.velocities[1], Eigen::Vector3f(4, 5, 6));
  EXPECT_THAT(particles.densities, testing::ElementsAre(1000.0F, 999.5F));
  EXPECT_THAT(particles.ids, testing::ElementsAre(3U, 9U));
}

TEST(Vtk, ReadsVersionFiveCellsAndMetadata) {
  const ParticleFileData particles = decodeString(
      "# vtk DataFile Version 5.1\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 1 double\n1 2 3\n"
      "METADATA\nINFORMATION 0\n\n"
      "CELLS 2 1\nOFFSETS vtktypeint64\n0 1\nCONNECTIVITY vtktypeint64\n0\nCELL_TYPES 1\n1\n"
      "CELL_DATA 1\nSCALARS id int\nLOOKUP_TABLE default\n5\n"
      "POINT_DATA 1\nSCALARS id int 1\nLOOKUP_TABLE default\n6\n",
      Format::Vtk);
  EXPECT_EQ(particles.positions[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_THAT(particles.ids, testing::ElementsAre(6U)) << "those of the points, not of the cells";
}

TEST(Vtk, ReadsScalarsWithoutLookupTable) {
  const ParticleFileData particles = decodeString(
      kHead + "POINTS 1 float\n1 2 3\nPOINT_DATA 1\nSCALARS rho float\n5\nVECTORS v float\n1 2 3\n", Format::Vtk);
  EXPECT_THAT(particles.densities, testing::ElementsAre(5.0F));
  EXPECT_EQ(particles.velocities[0], Eigen::Vector3f(1, 2, 3));
}

TEST(Vtk, RefusesWhatItDoesNotKnow) {
  EXPECT_THAT(decodeError("# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\n", Format::Vtk),
              HasSubstr("read are POLYDATA and UNSTRUCTURED_GRID"));
  EXPECT_THAT(decodeError(kHead + "WIBBLE 1\n", Format::Vtk), HasSubstr("WIBBLE"));
  EXPECT_THAT(decodeError(kHead + "POINTS 1 quad\n", Format::Vtk), HasSubstr("type of numbers"));
  EXPECT_THAT(decodeError(kHead, Format::Vtk), HasSubstr("no POINTS"));
  EXPECT_THAT(decodeError(kHead + "POINTS 1 float\n1 2 x\n", Format::Vtk), HasSubstr("\"x\" is not a number"));
}

TEST(Vtk, RefusesCountsThatLie) {
  for (const std::string points : {"1000000000000", "18446744073709551615", "-1", "99999999999999999999"}) {
    EXPECT_THAT(decodeError(kHead + "POINTS " + points + " float\n1 2 3\n", Format::Vtk), HasSubstr("at byte"))
        << points;
  }
  EXPECT_THAT(decodeError(kHead + "FIELD f 18446744073709551615\n", Format::Vtk), HasSubstr("cut off"));
  EXPECT_THAT(decodeError(kHead + "POINTS 1 float\n1 2 3\nPOINT_DATA 2\n", Format::Vtk), HasSubstr("for 1 points"));
}

}  // namespace
}  // namespace sluice::particleio::test
