#include "solvers/method.h"

#include <array>
#include <cmath>

#include "sluice/core/check.h"
#include "sluice/evaluate/report.h"

namespace sluice::evaluate {

namespace {

constexpr std::array kKinds{SolverKind::Dfsph, SolverKind::Iisph, SolverKind::Pbf, SolverKind::Wcsph,
                            SolverKind::DeltaSph};

Method withTolerance(SolverKind kind, double tolerance) {
  Method method;
  method.kind = kind;
  method.tolerance = tolerance;
  return method;
}

Method withCourant(SolverKind kind, double courant) {
  Method method;
  method.kind = kind;
  method.courant = courant;
  return method;
}

Method withIterations(std::uint32_t iterations) {
  Method method;
  method.kind = SolverKind::Pbf;
  method.iterations = iterations;
  return method;
}

}  // namespace

std::string Method::solver() const {
  switch (kind) {
    case SolverKind::Dfsph:
      return "dfsph";
    case SolverKind::Iisph:
      return "iisph";
    case SolverKind::Pbf:
      return "pbf";
    case SolverKind::Wcsph:
      return "wcsph";
    case SolverKind::DeltaSph:
      return "delta_sph";
  }
  SLUICE_CHECK(!"a kind of solver");
}

std::string Method::text() const {
  if (std::isfinite(tolerance)) return solver() + " " + shortText(tolerance) + " %";
  if (iterations > 0) return solver() + " " + std::to_string(iterations) + " iterations";
  return solver() + " Courant " + shortText(courant);
}

void choose(v1::Simulation& simulation, const Method& method) {
  switch (method.kind) {
    case SolverKind::Dfsph:
      simulation.mutable_dfsph()->set_density_error(method.tolerance);
      // As much more exact as the density solve: a divergence left over is compression a step later.
      simulation.mutable_dfsph()->set_divergence_error(2 * method.tolerance);
      return;
    case SolverKind::Iisph:
      simulation.mutable_iisph()->set_density_error(method.tolerance);
      return;
    case SolverKind::Pbf:
      simulation.mutable_pbf()->set_iterations(method.iterations);
      return;
    case SolverKind::DeltaSph:
      simulation.mutable_wcsph()->mutable_density_diffusion();
      simulation.mutable_wcsph()->set_courant(method.courant);
      return;
    case SolverKind::Wcsph:
      simulation.mutable_wcsph()->set_courant(method.courant);
      return;
  }
}

Method defaultMethod(SolverKind kind) {
  switch (kind) {
    case SolverKind::Dfsph:
      return withTolerance(kind, v1::Dfsph().density_error());
    case SolverKind::Iisph:
      return withTolerance(kind, v1::Iisph().density_error());
    case SolverKind::Pbf:
      return withIterations(v1::Pbf().iterations());
    default:
      return withCourant(kind, v1::Wcsph().courant());
  }
}

bool isDefault(const Method& method) { return method.text() == defaultMethod(method.kind).text(); }

std::vector<Method> solverMethods(bool quick) {
  std::vector<Method> methods;
  for (const SolverKind kind : kKinds) {
    if (quick) {
      methods.push_back(defaultMethod(kind));
      continue;
    }
    switch (kind) {
      case SolverKind::Pbf:
        for (const std::uint32_t iterations : {2U, 5U, 20U}) methods.push_back(withIterations(iterations));
        break;
      case SolverKind::Wcsph:
      case SolverKind::DeltaSph:
        for (const double courant : {0.4, 0.25, 0.1}) methods.push_back(withCourant(kind, courant));
        break;
      default:
        for (const double tolerance : {0.5, 0.05, 0.005}) methods.push_back(withTolerance(kind, tolerance));
    }
  }
  return methods;
}

}  // namespace sluice::evaluate
