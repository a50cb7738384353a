// Files that other programs wrote. They are not part of the project: the variable SLUICE_TEST_DATA names their folder.
#include <cstdlib>
#include <iostream>

#include "support.h"

namespace sluice::sources::test {
namespace {

struct Known {
  const char* name;
  double spacing;  ///< Twice the radius that the file was simulated with, m.
};

void PrintTo(const Known& known, std::ostream* out) { *out << known.name; }

class RealFiles : public testing::TestWithParam<Known> {};

TEST_P(RealFiles, GiveASceneThatFitsThem) {
  const char* data = std::getenv("SLUICE_TEST_DATA");
  if (data == nullptr) GTEST_SKIP() << "SLUICE_TEST_DATA names no folder with particle files from other programs";
  const std::string file = (std::filesystem::path(data) / "particles" / GetParam().name).string();
  const v1::Scene scene = sceneForParticleFile(file);
  const auto snapshot = openParticlePlayback(scene)->snapshot();
  std::cout << GetParam().name << ": " << snapshot->size() << " particles, bounds ("
            << snapshot->bounds.min().transpose() << ") to (" << snapshot->bounds.max().transpose() << "), spacing "
            << snapshot->spacing << ", floor " << scene.background().floor_height() << ", tiles "
            << scene.background().tile_size() << '\n';
  // Particles in motion come closer than they started.
  EXPECT_GT(snapshot->spacing, 0.7 * GetParam().spacing);
  EXPECT_LT(snapshot->spacing, 1.1 * GetParam().spacing);
}

INSTANTIATE_TEST_SUITE_P(FromOtherPrograms, RealFiles,
                         testing::Values(Known{"dam_break_frame_23_24389_particles.bgeo", 0.05},
                                         Known{"hilbert_46843_particles.bgeo", 0.05},
                                         Known{"double_dam_break_frame_26_4732_particles.vtk", 0.05},
                                         Known{"bunny_frame_14_7705_particles.vtk", 0.05}));

}  // namespace
}  // namespace sluice::sources::test
