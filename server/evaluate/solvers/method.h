#pragma once

#include <limits>
#include <string>
#include <vector>

#include "sluice/v1/scene.pb.h"

namespace sluice::evaluate {

enum class SolverKind { Dfsph, Iisph, Pbf, Wcsph, DeltaSph };

/// A pressure solver with how exactly it works.
struct Method {
  SolverKind kind = SolverKind::Dfsph;
  /// Mean compression at which DFSPH and IISPH stop, %; NaN for the solvers that have no tolerance.
  double tolerance = std::numeric_limits<double>::quiet_NaN();
  std::uint32_t iterations = 0;  ///< Of PBF in a step; 0 for the others.
  double courant = 0;            ///< Of WCSPH and delta-SPH; 0 for the others.

  /// "dfsph", "iisph", "pbf", "wcsph" or "delta_sph".
  std::string solver() const;
  /// The solver with its setting, for people and as a key: "dfsph 0.05 %".
  std::string text() const;
};

/// Makes a scene use it.
void choose(v1::Simulation& simulation, const Method& method);

/// Every solver: at its default in a quick sweep, over its range of tolerances, iterations or steps in a full one.
std::vector<Method> solverMethods(bool quick);

/// A solver at its default.
Method defaultMethod(SolverKind kind);
bool isDefault(const Method& method);

}  // namespace sluice::evaluate
