// What the solvers have to reach, each at the smallest resolution that shows it. The cases are those of
// `sluice-server evaluate solvers`, which sweeps them over resolutions and tolerances.

#include <cmath>

#include <gtest/gtest.h>

#include "solvers/run.h"

namespace sluice::evaluate {
namespace {

/// The error of a norm in a run of a case.
double errorOf(std::string_view caseName, const Method& method, int resolution, std::string_view norm) {
  Run run(method, resolution, 0);
  for (const Finding& finding : solverCase(caseName).run(run)) {
    if (finding.norm == norm) return finding.error;
  }
  ADD_FAILURE() << caseName << ": " << run.source().halted();
  return std::nan("");
}

Method dfsph() { return defaultMethod(SolverKind::Dfsph); }

// Symplectic Euler is behind by g t dt/2, 4.905 mm of steps of 1 ms; the rounding of floats adds a little.
TEST(Validation, FreeFallErrsByHalfAStep) {
  EXPECT_NEAR(errorOf("free fall", dfsph(), 1000, "position after 1 s, m"), 4.905e-3, 5e-5);
}

TEST(Validation, AColumnOfFortyLayersHasTheHydrostaticPressure) {
  evaluate::Run run(dfsph(), 40, 0);
  const std::vector<Finding> findings = solverCase("hydrostatic column").run(run);
  ASSERT_EQ(findings.size(), 3U) << run.source().halted();
  EXPECT_LT(findings[0].error, 0.05) << findings[0].norm;
  EXPECT_LT(findings[1].error, 0.05) << findings[1].norm;
  EXPECT_LT(findings[2].error, 2e-2) << findings[2].norm;
}

TEST(Validation, AColumnOfAHundredLayersHasTheHydrostaticPressure) {
  for (const SolverKind kind : {SolverKind::Dfsph, SolverKind::Iisph}) {
    EXPECT_LT(errorOf("hydrostatic column", defaultMethod(kind), 100, "L2 of pressure"), 0.05)
        << defaultMethod(kind).text();
  }
}

TEST(Validation, TheFrontOfADamBreakIsThatOfMartinAndMoyce) {
  EXPECT_LT(errorOf("dam break", dfsph(), 20, "front, largest relative, T < 3.3"), 0.08);
}

TEST(Validation, PoiseuilleFlowStartsAsItShould) {
  EXPECT_LT(errorOf("poiseuille", dfsph(), 50, "L2 of velocity"), 0.02);
}

TEST(Validation, CouetteFlowStartsAsItShould) { EXPECT_LT(errorOf("couette", dfsph(), 50, "L2 of velocity"), 0.02); }

TEST(Validation, AStrainedDropBecomesTheRightEllipse) {
  for (const SolverKind kind : {SolverKind::Dfsph, SolverKind::Iisph, SolverKind::Pbf, SolverKind::Wcsph}) {
    EXPECT_LT(errorOf("elliptic drop", defaultMethod(kind), 20, "half height"), 0.02) << defaultMethod(kind).text();
  }
}

TEST(Validation, ADropUnderACentralForceSwingsInTime) {
  EXPECT_LT(errorOf("oscillating drop", dfsph(), 12, "period"), 0.02);
}

TEST(Validation, AStandingWaveHasItsPeriod) {
  for (const SolverKind kind : {SolverKind::Dfsph, SolverKind::Iisph, SolverKind::Wcsph}) {
    EXPECT_LT(errorOf("standing wave", defaultMethod(kind), 20, "period"), 0.02) << defaultMethod(kind).text();
  }
}

// Floats: a few hundred steps round velocities of 1.5 m/s by 2^-24 each, at random.
TEST(Validation, NoSolverLosesMomentumWithoutWalls) {
  for (const Method& method : solverMethods(true)) {
    EXPECT_LT(errorOf("collision", method, 16, "momentum drift over m v"), 2e-7) << method.text();
  }
}

TEST(Validation, NoSolverGainsEnergyInACollision) {
  for (const Method& method : solverMethods(true)) {
    EXPECT_LT(errorOf("collision", method, 16, "energy gained"), 1e-6) << method.text();
  }
}

}  // namespace
}  // namespace sluice::evaluate
