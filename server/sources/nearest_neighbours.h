#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace sluice::sources {

/// The median over the points of the distance to the nearest point elsewhere; points that coincide count as one. 0
/// where fewer than two remain. Measured at `samples` points spread evenly over the sorted points where there are more.
double medianNearestNeighbourDistance(std::vector<Eigen::Vector3f> points, std::size_t samples = 20'000);

}  // namespace sluice::sources
