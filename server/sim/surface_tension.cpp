#include "surface_tension.h"

#include "surface_tension_akinci2013.h"
#include "surface_tension_he2014.h"

namespace sluice::sim {

std::unique_ptr<SurfaceTension> makeSurfaceTension(const v1::Simulation& simulation) {
  if (!simulation.has_surface_tension()) return nullptr;
  if (simulation.surface_tension().has_he2014()) return std::make_unique<He2014Tension>();
  return std::make_unique<Akinci2013Tension>();
}

void ColourGradient::compute(Weight by, const StepContext& step) {
  const NeighbourLists& lists = step.lists;
  const std::size_t particles = step.state.size();
  for (std::vector<Float4>* values : {&weight_, &gradient_, &ofFluid_}) values->resize(particles);

  weight_.assign(particles, {1, 1, 1, 1});
  step.team.forEachChunk(particles, [&](const Chunk& chunk) {
    lists.loops().weightedGradient(lists.chunk(chunk), weight_.data(), ofFluid_.data());
  });
  step.team.forEachChunk(particles, [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const float weight = by == Weight::Volume ? 1 / lists.density()[i] : lists.density()[i];
      weight_[i] = {weight, weight, weight, weight};
    }
  });
  step.team.forEachChunk(particles, [&](const Chunk& chunk) {
    lists.loops().weightedGradient(lists.chunk(chunk), weight_.data(), gradient_.data());
    const std::vector<WallContact>& contacts = lists.wallContacts(chunk);
    auto contact = contacts.begin();
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      // The walls' share, once; exactly 0 without walls, because the sums over the fluid are sums of integers.
      const bool mirrored = contact != contacts.end() && contact->particle == i;
      if (mirrored) ++contact;
      const float share = mirrored ? 1 / wallMirror(lists.density()[i]) : 1;
      const Float4& all = lists.gradientSum()[i];
      const Float4& fluid = ofFluid_[i];
      gradient_[i].x += share * (all.x - fluid.x);
      gradient_[i].y += share * (all.y - fluid.y);
      gradient_[i].z += share * (all.z - fluid.z);
    }
  });
}

}  // namespace sluice::sim
