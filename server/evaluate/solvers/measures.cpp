#include "solvers/measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace sluice::evaluate {

double RelativeL2::value() const { return std::sqrt(difference_ / square_); }

PlaneMoments planeMoments(const core::ParticleSnapshot& particles) {
  PlaneMoments moments;
  const auto count = static_cast<double>(particles.size());
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < particles.size(); ++i) {
    centre += particles.positions[i].cast<double>() / count;
    moments.momentum += particles.velocities[i].cast<double>() / count;
  }
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Eigen::Vector3d x = particles.positions[i].cast<double>() - centre;
    const Eigen::Vector3d v = particles.velocities[i].cast<double>();
    moments.xx += x[0] * x[0] / count;
    moments.yy += x[1] * x[1] / count;
    moments.xy += x[0] * x[1] / count;
    moments.kinetic += 0.5 * v.squaredNorm() / count;
    moments.spin += (x[0] * v[1] - x[1] * v[0]) / count;
  }
  return moments;
}

std::vector<double> interpolated(const core::ParticleSnapshot& particles, const std::vector<double>& values) {
  const double support = 2 * particles.spacing;
  const auto cellOf = [&](const Eigen::Vector3f& x, int dx, int dy, int dz) {
    const auto along = [&](float place, int step) {
      return static_cast<std::int64_t>(std::floor(place / support)) + step;
    };
    return std::array<std::int64_t, 3>{along(x.x(), dx), along(x.y(), dy), along(x.z(), dz)};
  };
  std::map<std::array<std::int64_t, 3>, std::vector<std::size_t>> cells;
  for (std::size_t i = 0; i < particles.size(); ++i) cells[cellOf(particles.positions[i], 0, 0, 0)].push_back(i);
  // The cubic spline without its factor.
  const auto weight = [&](double q) {
    return 2 * std::pow(std::max(1 - q, 0.0), 3) - std::pow(std::max(1 - 2 * q, 0.0), 3);
  };
  std::vector<double> field(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    double sum = 0;
    double weights = 0;
    for (int c = 0; c < 27; ++c) {
      const auto cell = cells.find(cellOf(particles.positions[i], c % 3 - 1, c / 3 % 3 - 1, c / 9 - 1));
      if (cell == cells.end()) continue;
      for (const std::size_t j : cell->second) {
        const double w = weight((particles.positions[i] - particles.positions[j]).norm() / support);
        sum += w * values[j];
        weights += w;
      }
    }
    field[i] = sum / weights;
  }
  return field;
}

void Oscillation::add(double time, double value) {
  times_.push_back(time);
  values_.push_back(value);
}

double Oscillation::period(double level) const {
  std::vector<double> rising;
  std::vector<double> falling;
  for (std::size_t i = 1; i < values_.size(); ++i) {
    const double before = values_[i - 1] - level;
    const double after = values_[i] - level;
    if ((before < 0) == (after < 0)) continue;
    const double at = times_[i - 1] + (times_[i] - times_[i - 1]) * before / (before - after);
    (before < 0 ? rising : falling).push_back(at);
  }
  double sum = 0;
  double periods = 0;
  for (const std::vector<double>& crossings : {rising, falling}) {
    if (crossings.size() < 2) continue;
    sum += crossings.back() - crossings.front();
    periods += static_cast<double>(crossings.size() - 1);
  }
  return periods > 0 ? sum / periods : std::numeric_limits<double>::quiet_NaN();
}

double Oscillation::highest() const { return *std::ranges::max_element(values_); }
double Oscillation::lowest() const { return *std::ranges::min_element(values_); }

std::vector<double> Oscillation::peaks() const {
  std::vector<double> peaks;
  double largest = 0;
  for (std::size_t i = 1; i < values_.size(); ++i) {
    largest = std::max(largest, std::abs(values_[i]));
    if ((values_[i - 1] < 0) == (values_[i] < 0)) continue;
    peaks.push_back(largest);
    largest = 0;
  }
  return peaks;
}

}  // namespace sluice::evaluate
