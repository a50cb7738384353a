#include "boundary.h"

#include <cmath>

#include <gtest/gtest.h>

#include "lattice.h"
#include "neighbour_lists.h"
#include "scenes.h"

namespace sluice::sim {
namespace {

constexpr double kSupport = 0.1;

Discretisation discretisationOf(KernelKind kernel, double support) {
  return {3, kernel, kSpacing, support, particleVolume(kernel, kSpacing, support)};
}

const Discretisation kCubic = discretisationOf(KernelKind::CubicSpline, kSupport);

Boundary boxOf(const std::array<double, 3>& size) {
  return {{{}, size, {}}, {}, kCubic, CellGeometry::covering(size, kSupport, 1 << 16), Team(1)};
}

TEST(Boundary, CoversTheFacesAndNothingElse) {
  const std::array<double, 3> size{0.5, 0.7, 0.62};
  const Boundary box = boxOf(size);
  EXPECT_EQ(static_cast<double>(box.size()), Boundary::expectedCount({{}, size, {}}, kCubic));
  // 10 × 14 × 13 intervals.
  EXPECT_EQ(box.size(), 11U * 15 * 14 - 9U * 13 * 12);
  for (const Float4& p : box.points()) {
    const auto onFace = [](float x, double length) {
      return std::abs(x) < 1e-6 || std::abs(x - static_cast<float>(length)) < 1e-6;
    };
    EXPECT_TRUE(onFace(p.x, size[0]) || onFace(p.y, size[1]) || onFace(p.z, size[2]));
  }
}

TEST(Boundary, WideSupportsHaveWallsOfSeveralLayers) {
  const Container container{{}, {0.5, 0.5, 0.5}, {}};
  for (const int layers : {1, 2, 3}) {
    const double support = (layers + 1) * kSpacing;
    const Discretisation wide = discretisationOf(KernelKind::WendlandC2, support);
    const Boundary box(container, {}, wide, CellGeometry::covering(container.size, support, 1 << 16), Team(1));
    const int across = 9 + 2 * layers;
    EXPECT_EQ(box.size(), static_cast<std::size_t>(across * across * across - 9 * 9 * 9));
    EXPECT_EQ(Boundary::expectedCount(container, wide), static_cast<double>(box.size()));
    for (const Float4& p : box.points()) {
      const auto within = [](float x) { return x > 0.001F && x < 0.499F; };
      ASSERT_FALSE(within(p.x) && within(p.y) && within(p.z));
    }
  }
}

// V_b Σ_k W_bk is the same on a face, in an edge and in a corner, and for any spacing of the samples.
TEST(Boundary, VolumesMakeEverySampledPlaceCountAlike) {
  for (const std::array<double, 3>& size : {std::array<double, 3>{0.5, 0.5, 0.5}, {0.52, 0.37, 0.61}}) {
    const Boundary box = boxOf(size);
    double reference = 0;
    for (std::size_t b = 0; b < box.size(); ++b) {
      double sum = 0;
      for (const Float4& k : box.points()) {
        const Float4& p = box.points()[b];
        const double dx = p.x - k.x;
        const double dy = p.y - k.y;
        const double dz = p.z - k.z;
        sum += kernelValue<CubicSpline>(std::sqrt(dx * dx + dy * dy + dz * dz), kSupport);
      }
      if (b == 0) reference = box.volumes()[b] * sum;
      ASSERT_NEAR(box.volumes()[b] * sum, reference, 1e-5 * reference);
    }
    EXPECT_GT(reference, 0);
  }
}

// A lattice that fills a box, its outermost layers one spacing from the faces.
TEST(Boundary, FluidAtRestAgainstAFaceHasRestDensity) {
  const FluidSimulation simulation(column(12, 12));
  const ParticleState& state = simulation.state();
  const double side = 13 * kSpacing;
  int onFace = 0;
  int inEdge = 0;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Float4& x = state.position[i];
    if (x.y > 11.5F * static_cast<float>(kSpacing)) continue;  // the free surface
    int near = 0;
    for (const double distance : {double{x.x}, side - x.x, double{x.z}, side - x.z, double{x.y}}) {
      if (distance < 1.5 * kSpacing) ++near;
    }
    const float density = simulation.neighbours().density()[i];
    if (near == 0) {
      EXPECT_NEAR(density, 1, 1e-4);
    } else if (near == 1) {
      ++onFace;
      EXPECT_NEAR(density, 1, 0.01);
    } else {
      // Akinci's volumes know only that faces meet, not at which angle.
      ++inEdge;
      EXPECT_NEAR(density, 1, 0.12);
    }
  }
  EXPECT_GT(onFace, 100);
  EXPECT_GT(inEdge, 10);
}

}  // namespace
}  // namespace sluice::sim
