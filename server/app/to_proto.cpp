#include "sluice/app/to_proto.h"

namespace sluice::app {

v1::Stats toProto(const core::StepStatistics& statistics, const core::FlowMeasures& measures) {
  v1::Stats stats;
  stats.set_steps(statistics.steps);
  stats.set_time_step_seconds(statistics.timeStepSeconds);
  stats.set_time_step_limit(statistics.timeStepLimit);
  stats.set_density_iterations(statistics.densityIterations);
  stats.set_divergence_iterations(statistics.divergenceIterations);
  stats.set_mean_density_error(statistics.meanDensityError);
  stats.set_max_density_error(statistics.maxDensityError);
  stats.set_mean_divergence(measures.meanDivergence);
  stats.set_max_divergence(measures.maxDivergence);
  stats.set_kinetic_energy(measures.kineticEnergy);
  stats.set_potential_energy(measures.potentialEnergy);
  stats.set_momentum_drift(measures.momentumDrift);
  for (const core::StageTime& stage : statistics.stages) {
    v1::StageTime& out = *stats.add_stages();
    out.set_name(stage.name);
    out.set_milliseconds(stage.milliseconds);
  }
  return stats;
}

v1::Plan toProto(const core::Plan& plan) {
  v1::Plan out;
  for (const core::PlannedStage& stage : plan.stages) {
    v1::Plan::Stage& s = *out.add_stages();
    s.set_name(stage.name);
    for (const std::string& read : stage.reads) s.add_reads(read);
    for (const std::string& write : stage.writes) s.add_writes(write);
  }
  for (const core::PlannedBuffer& buffer : plan.buffers) {
    v1::Plan::Buffer& b = *out.add_buffers();
    b.set_name(buffer.name);
    b.set_bytes(buffer.bytes);
  }
  for (const core::LeftOut& leftOut : plan.leftOut) {
    v1::Plan::LeftOut& l = *out.add_left_out();
    l.set_name(leftOut.name);
    l.set_reason(leftOut.reason);
  }
  return out;
}

namespace {

void set(v1::Vec3& out, const Eigen::Vector3f& v) {
  out.set_x(v.x());
  out.set_y(v.y());
  out.set_z(v.z());
}

}  // namespace

v1::Picked toProto(const std::optional<render::PickedFluid>& picked, const core::ParticleSnapshot& particles) {
  v1::Picked out;
  out.set_simulation_time(particles.time);
  out.set_snapshot_sequence(particles.sequence);
  out.set_hit(picked.has_value());
  if (!picked) return out;
  set(*out.mutable_position(), picked->position);
  set(*out.mutable_velocity(), picked->velocity);
  out.set_depth(picked->depth);
  out.set_thickness(picked->thickness);
  out.set_density(picked->density);
  out.set_fluid(picked->fluid);
  return out;
}

core::Interaction fromProto(const v1::Interact& interact) {
  core::Interaction out;
  out.action = interact.action() == v1::Interact::PULL  ? core::Interaction::Action::Pull
               : interact.action() == v1::Interact::ADD ? core::Interaction::Action::Add
                                                        : core::Interaction::Action::Push;
  const v1::Vec3& o = interact.origin();
  const v1::Vec3& d = interact.direction();
  out.origin = {o.x(), o.y(), o.z()};
  out.direction = Eigen::Vector3d(d.x(), d.y(), d.z()).normalized();
  out.radius = interact.radius();
  if (interact.strength() > 0) out.strength = interact.strength();
  if (interact.seconds() > 0) out.seconds = interact.seconds();
  out.fluid = interact.fluid();
  return out;
}

}  // namespace sluice::app
