// Files that other programs wrote. They are not part of the project: the variable SLUICE_TEST_DATA names their folder.
#include <cstdlib>
#include <filesystem>
#include <ostream>

#include <Eigen/Geometry>

#include "support.h"

namespace sluice::particleio::test {
namespace {

struct Known {
  const char* name;
  std::size_t particles;
  bool velocitiesAndIds;
};

void PrintTo(const Known& known, std::ostream* out) { *out << known.name; }

class RealFiles : public testing::TestWithParam<Known> {};

TEST_P(RealFiles, AreRead) {
  const char* data = std::getenv("SLUICE_TEST_DATA");
  if (data == nullptr) GTEST_SKIP() << "SLUICE_TEST_DATA names no folder with particle files from other programs";
  const std::filesystem::path file = std::filesystem::path(data) / "particles" / GetParam().name;
  const ParticleFileData particles = readParticleFile(file);
  EXPECT_EQ(particles.size(), GetParam().particles);
  EXPECT_EQ(particles.velocities.size(), GetParam().velocitiesAndIds ? particles.size() : 0);
  EXPECT_EQ(particles.ids.size(), GetParam().velocitiesAndIds ? particles.size() : 0);
  Eigen::AlignedBox3f bounds;
  for (const Eigen::Vector3f& position : particles.positions) bounds.extend(position);
  // Simulations at the scale of a room: numbers read in a wrong byte order are far from it.
  EXPECT_LT(bounds.max().maxCoeff(), 10);
  EXPECT_GT(bounds.min().minCoeff(), -10);
  EXPECT_GT(bounds.sizes().minCoeff(), 0.1);
}

INSTANTIATE_TEST_SUITE_P(FromOtherPrograms, RealFiles,
                         testing::Values(Known{"dam_break_frame_23_24389_particles.bgeo", 24389, false},
                                         Known{"hilbert_46843_particles.bgeo", 46843, false},
                                         Known{"double_dam_break_frame_26_4732_particles.vtk", 4732, true},
                                         // Its name says 7705; its header, and its documentation, 7706.
                                         Known{"bunny_frame_14_7705_particles.vtk", 7706, true}));

}  // namespace
}  // namespace sluice::particleio::test
