#include "micropolar.h"

namespace sluice::sim {

void MicropolarModel::apply(const v1::Micropolar& settings, StepContext& step) {
  ParticleState& state = step.state;
  const double transfer = settings.transfer() * step.seconds;
  const SpinExchange exchange{static_cast<float>(transfer), static_cast<float>(settings.inverse_inertia() * transfer),
                              static_cast<float>(settings.spin_smoothing())};
  velocity_.resize(state.size());
  spin_.resize(state.size());
  step.team.forEachChunk(state.size(), [&](const Chunk& chunk) {
    step.lists.loops().exchangeSpin(step.lists.chunk(chunk), step.lists.scale(), exchange, state.position.data(),
                                    state.velocity.data(), state.spin.data(), velocity_.data(), spin_.data());
  });
  state.velocity.swap(velocity_);
  state.spin.swap(spin_);
}

}  // namespace sluice::sim
