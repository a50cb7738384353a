#include "interior_particles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "particle_grid.h"

namespace sluice::render {

namespace {

/// Cells around a thin place that count as being near it; at a cell edge of at least the spacing, two of them reach
/// from 2 to 3 spacings far.
constexpr int kReach = 2;

/// Lets every marked cell mark the `kReach` cells before and after it along one axis.
void spread(std::vector<char>& marks, const ParticleCells& cells, int axis) {
  const std::size_t length = static_cast<std::size_t>(cells.count[static_cast<std::size_t>(axis)]);
  const std::array<std::size_t, 3> strides{1, static_cast<std::size_t>(cells.count[0]), cells.index(0, 0, 1)};
  const std::size_t stride = strides[static_cast<std::size_t>(axis)];
  const auto lines = static_cast<std::ptrdiff_t>(cells.total() / length);
#pragma omp parallel
  {
    std::vector<char> line(length + 2 * kReach);
#pragma omp for schedule(static)
    for (std::ptrdiff_t k = 0; k < lines; ++k) {
      const auto number = static_cast<std::size_t>(k);
      char* const first = marks.data() + number / stride * stride * length + number % stride;
      for (std::size_t i = 0; i < length; ++i) line[i + kReach] = first[i * stride];
      for (std::size_t i = 0; i < length; ++i) {
        char any = 0;
        for (std::size_t j = i; j <= i + 2 * kReach; ++j) any = static_cast<char>(any | line[j]);
        first[i * stride] = any;
      }
    }
  }
}

}  // namespace

std::vector<char> findInterior(const core::ParticleSnapshot& particles) {
  const double ratio = particles.supportRadius / particles.spacing;
  const double full = 0.75 * 4.0 / 3.0 * std::numbers::pi * ratio * ratio * ratio;
  const ParticleCells cells = ParticleCells::covering(particles.positions, static_cast<float>(particles.spacing));

  const auto cellIndex = [&](std::size_t i) {
    const auto [x, y, z] = cells.cellOf(particles.positions[i]);
    return cells.index(x, y, z);
  };
  std::vector<char> nearThin(cells.total(), 0);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (particles.neighbours[i] < full) nearThin[cellIndex(i)] = 1;
  }
  for (int axis = 0; axis < 3; ++axis) spread(nearThin, cells, axis);

  std::vector<char> interior(particles.size());
  const auto count = static_cast<std::ptrdiff_t>(particles.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    const auto i = static_cast<std::size_t>(k);
    interior[i] = static_cast<char>(nearThin[cellIndex(i)] == 0);
  }
  return interior;
}

}  // namespace sluice::render
