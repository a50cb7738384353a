#include "solvers/scenes.h"

namespace sluice::evaluate {

v1::Simulation planarScene(double spacing, const Rectangle& container) {
  v1::Simulation simulation;
  simulation.set_planar(true);
  simulation.set_particle_spacing(spacing);
  simulation.mutable_gravity()->set_y(0);
  v1::Box& box = *simulation.mutable_container();
  box.mutable_min()->set_x(container.left);
  box.mutable_min()->set_y(container.bottom);
  box.mutable_min()->set_z(-2 * spacing);
  box.mutable_max()->set_x(container.right);
  box.mutable_max()->set_y(container.top);
  box.mutable_max()->set_z(2 * spacing);
  simulation.add_fluids()->set_viscosity(0);
  return simulation;
}

void useWendland(v1::Simulation& simulation, double supportInSpacings) {
  simulation.mutable_wendland_c2()->set_support_in_spacings(supportInSpacings);
}

void setSpeedOfSound(v1::Simulation& simulation, double metresPerSecond, bool negativePressure) {
  simulation.mutable_wcsph()->set_speed_of_sound(metresPerSecond);
  simulation.mutable_wcsph()->set_negative_pressure(negativePressure);
}

std::vector<Eigen::Vector3d> block(double spacing, double clearance, int columns, int rows) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      points.emplace_back((i + clearance) * spacing, (j + clearance) * spacing, 0);
    }
  }
  return points;
}

}  // namespace sluice::evaluate
