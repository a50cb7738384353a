#include "move_check.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace sluice::sim {

namespace {

struct SpeedCheck {
  double largestSquare = 0;
  bool finite = true;

  SpeedCheck& operator+=(const SpeedCheck& other) {
    largestSquare = std::max(largestSquare, other.largestSquare);
    finite = finite && other.finite;
    return *this;
  }
};

double squaredNorm(const Float4& v) {
  return static_cast<double>(v.x) * v.x + static_cast<double>(v.y) * v.y + static_cast<double>(v.z) * v.z;
}

}  // namespace

double checkedMaxSpeed(StepContext& step) {
  const std::vector<Float4>& velocity = step.state.velocity;
  const auto check = step.team.sumOverChunks<SpeedCheck>(velocity.size(), [&](const Chunk& chunk) {
    SpeedCheck part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const double square = squaredNorm(velocity[i]);
      part.largestSquare = std::max(part.largestSquare, square);
      part.finite = part.finite && std::isfinite(square);
    }
    return part;
  });
  const double fastest = std::sqrt(check.largestSquare);
  const double spacings = fastest * step.seconds / step.discretisation.spacing;
  if (!check.finite) {
    step.trouble = "velocities are no longer finite";
  } else if (spacings > kLargestMove) {
    std::ostringstream text;
    text << "a particle would move by " << spacings << " particle spacings in one step";
    step.trouble = text.str();
  }
  return fastest;
}

}  // namespace sluice::sim
