#include "smoothing/rkl_stages.h"

#include "sluice/core/check.h"

namespace sluice::render {

namespace {

/// b_j, Eq. (16) [MBA14], the same for j = 0 to 2.
double weight(int j) {
  if (j < 2) return 1.0 / 3.0;
  return (j * j + j - 2.0) / (2.0 * j * (j + 1.0));
}

}  // namespace

double rklLength(int stages) { return (static_cast<double>(stages) * stages + stages - 2) / 4; }

std::vector<RklStage> rklStages(int stages) {
  SLUICE_CHECK(stages >= 3 && stages % 2 == 1);
  const double w1 = 1 / rklLength(stages);
  std::vector<RklStage> steps;
  steps.push_back({0, 0, 0, weight(1) * w1});
  for (int j = 2; j <= stages; ++j) {
    const double mu = (2.0 * j - 1) / j * weight(j) / weight(j - 1);
    const double nu = -(j - 1.0) / j * weight(j) / weight(j - 2);
    const double rate = mu * w1;
    steps.push_back({mu, nu, rate, -(1 - weight(j - 1)) * rate});
  }
  return steps;
}

}  // namespace sluice::render
