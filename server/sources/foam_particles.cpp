#include "foam_particles.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

#include "foam_sums.h"

namespace sluice::sources {

namespace {

using core::DiffuseKind;
using Eigen::Vector3f;

/// Drag is the share of a bubble's difference from the liquid that it loses in this time, s. With the defaults bubbles
/// then rise by 0.25 m/s, as those of 2 to 10 mm do in water.
constexpr float kDragSeconds = 0.02F;

/// Beyond the liquid's bounds by this many L a particle has left for good.
constexpr float kOutOfTheScene = 1;

/// Of the liquid particle's speed, across its way: what opens a jet of spray into a fan.
constexpr float kSpread = 0.12F;

/// Share of its lifetime that new foam has at least, so that what is made together does not vanish at once.
constexpr float kLeastLife = 0.4F;

/// SplitMix64's finaliser [Steele, Lea & Flood 2014].
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// Numbers in [0, 1) that depend on nothing but where they are drawn.
class Dice {
 public:
  Dice(std::uint64_t seed, std::uint64_t step, std::uint64_t id)
      : state_(mixed(mixed(mixed(seed + kGolden) + step) + id)) {}

  float roll() {
    state_ += kGolden;
    return static_cast<float>(mixed(state_) >> 40) * 0x1p-24F;
  }

 private:
  static constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ULL;

  std::uint64_t state_;
};

struct Motion {
  Vector3f position;
  Vector3f velocity;
};

Motion fall(const Motion& from, const Vector3f& gravity, float seconds) {
  return {from.position + seconds * from.velocity + 0.5F * seconds * seconds * gravity,
          from.velocity + seconds * gravity};
}

/// Drag towards the liquid's velocity and buoyancy: v' = λ(u - v) - k_b g, solved exactly, so that neither the length
/// of a step nor any drag makes it unstable.
Motion rise(const Motion& from, const Vector3f& liquid, const FoamLife& life, float seconds) {
  const float kept = 1 - life.drag;
  if (kept <= 0) return {from.position + seconds * liquid, liquid};
  const Vector3f lift = -life.buoyancy * life.gravity;
  const float rate = -std::log(kept) / kDragSeconds;
  // Below this the exponentials' differences are noise; what is left out is as small.
  if (rate * seconds < 1e-3F) return fall(from, lift, seconds);
  const Vector3f terminal = liquid + lift / rate;
  const float decay = std::exp(-rate * seconds);
  return {from.position + seconds * terminal + (1 - decay) / rate * (from.velocity - terminal),
          terminal + decay * (from.velocity - terminal)};
}

}  // namespace

DiffuseKind kindOf(float neighbours) {
  if (neighbours < 6) return DiffuseKind::Spray;
  return neighbours <= 20 ? DiffuseKind::Foam : DiffuseKind::Bubble;
}

void FoamParticles::add(const Vector3f& position, const Vector3f& velocity, DiffuseKind kind, float remaining) {
  all_.positions.push_back(position);
  all_.velocities.push_back(velocity);
  all_.kinds.push_back(kind);
  all_.remaining.push_back(remaining);
  all_.ids.push_back(nextId_++);
}

void FoamParticles::advance(const LiquidGrid& liquid, const FoamWalls& walls, const FoamScales& scales,
                            const FoamLife& life, float seconds, int threads) {
  const auto count = static_cast<std::ptrdiff_t>(all_.size());
  // The liquid has moved on already: what is around a particle is looked up where it comes to.
  const auto ahead = [&](std::size_t i) -> Vector3f {
    const Motion now{all_.positions[i], all_.velocities[i]};
    return all_.kinds[i] == DiffuseKind::Spray ? fall(now, life.gravity, seconds).position
                                               : Vector3f(now.position + seconds * now.velocity);
  };
  cell_.resize(all_.size());
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    cell_[static_cast<std::size_t>(i)] = liquid.cellOf(ahead(static_cast<std::size_t>(i)));
  }
  std::vector<std::uint32_t> starts(liquid.cellCount() + 1, 0);
  for (const std::uint32_t cell : cell_) ++starts[cell + 1];
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  order_.resize(all_.size());
  std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
  for (std::uint32_t i = 0; i < cell_.size(); ++i) order_[next[cell_[i]]++] = i;
  std::vector<std::uint32_t> cells;
  for (std::uint32_t cell = 0; cell < liquid.cellCount(); ++cell) {
    if (starts[cell] < starts[cell + 1]) cells.push_back(cell);
  }

  const Vector3f reach = Vector3f::Constant(kOutOfTheScene * scales.length);
  Eigen::AlignedBox3f scene = liquid.bounds();
  scene.extend(Vector3f(scene.min() - reach)).extend(Vector3f(scene.max() + reach));
  const auto step = [&](std::size_t i, const NearbyLiquid& nearby) {
    const Motion now{all_.positions[i], all_.velocities[i]};
    const Vector3f there = ahead(i);
    const SurroundingSums around = sumSurroundings(nearby, there, scales.support);
    // With nothing within h there is no liquid to follow.
    const DiffuseKind kind = around.weight > 0
                                 ? kindOf(around.count / walls.openShare(there, scales.support, scales.spacing))
                                 : DiffuseKind::Spray;
    Motion then;
    if (kind == DiffuseKind::Spray) {
      then = fall(now, life.gravity, seconds);
    } else {
      const Vector3f velocity = around.velocity / around.weight;
      then = kind == DiffuseKind::Foam ? Motion{now.position + seconds * velocity, velocity}
                                       : rise(now, velocity, life, seconds);
    }
    if (kind == DiffuseKind::Foam) all_.remaining[i] -= seconds / life.lifetime;
    walls.hold(now.position, then.position, then.velocity);
    if (walls.areClosed()) {
      if (kind == DiffuseKind::Spray && walls.isOnGround(then.position, life.gravity)) all_.remaining[i] = 0;
    } else if (!scene.contains(then.position)) {
      all_.remaining[i] = 0;
    }
    all_.kinds[i] = kind;
    all_.positions[i] = then.position;
    all_.velocities[i] = then.velocity;
  };
  const auto cellsToVisit = static_cast<std::ptrdiff_t>(cells.size());
#pragma omp parallel num_threads(threads)
  {
    NearbyLiquid nearby;
#pragma omp for schedule(dynamic, 8)
    for (std::ptrdiff_t c = 0; c < cellsToVisit; ++c) {
      const std::uint32_t cell = cells[static_cast<std::size_t>(c)];
      liquid.gather(cell, nearby);
      for (std::uint32_t k = starts[cell]; k < starts[cell + 1]; ++k) step(order_[k], nearby);
    }
  }
  removeUnless([&](std::size_t i) { return all_.remaining[i] > 0; });
}

void FoamParticles::create(const LiquidGrid& liquid, const FoamPotentials& potentials,
                           std::span<const std::uint32_t> ids, const FoamWalls& walls, const FoamScales& scales,
                           float seconds) {
  ++step_;
  // Even the most violent particle makes no more at a time: they would be one white blot.
  constexpr float kMostOfOne = 50;
  for (std::size_t k = 0; k < liquid.size(); ++k) {
    const float rate = potentials.rates()[k];
    if (!(rate > 0)) continue;
    const std::uint32_t source = liquid.inSnapshot(k);
    Dice dice(seed_, step_, ids.empty() ? source : ids[source]);
    const auto made = static_cast<int>(std::min(rate * seconds, kMostOfOne) + dice.roll());
    if (made == 0) continue;

    const Vector3f velocity = liquid.velocity(k);
    const float speed = velocity.norm();
    const Vector3f along = speed > 0 ? Vector3f(velocity / speed) : Vector3f(Vector3f::UnitY());
    const Vector3f across = along.unitOrthogonal();
    const Vector3f other = along.cross(across);
    for (int n = 0; n < made; ++n) {
      // In a cylinder along the particle's way, Eq. (8) [Ihmsen et al. 2012].
      const float radius = std::sqrt(dice.roll());
      const float angle = 2 * std::numbers::pi_v<float> * dice.roll();
      const Vector3f aside = radius * (std::cos(angle) * across + std::sin(angle) * other);
      Motion born{liquid.position(k) + 0.5F * scales.spacing * aside - dice.roll() * seconds * velocity,
                  velocity + kSpread * speed * aside};
      walls.hold(liquid.position(k), born.position, born.velocity);
      add(born.position, born.velocity, kindOf(potentials.neighbours()[k]),
          kLeastLife + (1 - kLeastLife) * dice.roll());
    }
  }
}

void FoamParticles::save(core::StateWriter& out) const {
  const auto writeVectors = [&](const std::vector<Vector3f>& vectors) {
    out.write(vectors.empty() ? std::span<const float>() : std::span(vectors.front().data(), 3 * vectors.size()));
  };
  writeVectors(all_.positions);
  writeVectors(all_.velocities);
  out.write(all_.kinds);
  out.write(all_.remaining);
  out.write(all_.ids);
  out.write(nextId_);
  out.write(step_);
}

void FoamParticles::resume(core::StateReader& in) {
  const auto readVectors = [&](std::vector<Vector3f>& vectors) {
    std::vector<float> components;
    in.read(components);
    vectors.resize(components.size() / 3);
    for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] = Eigen::Map<const Vector3f>(&components[3 * i]);
  };
  readVectors(all_.positions);
  readVectors(all_.velocities);
  in.read(all_.kinds);
  in.read(all_.remaining);
  in.read(all_.ids);
  in.read(nextId_);
  in.read(step_);
  const std::size_t count = all_.size();
  const bool known = std::ranges::all_of(all_.kinds, [](DiffuseKind kind) { return kind <= DiffuseKind::Bubble; });
  if (all_.velocities.size() != count || all_.kinds.size() != count || all_.remaining.size() != count ||
      all_.ids.size() != count || !known) {
    in.fail("the foam's arrays do not fit together");
  }
}

void FoamParticles::keepAtMost(std::size_t most) {
  if (all_.size() <= most) return;
  std::vector<std::uint32_t> order(all_.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto goesBefore = [&](std::uint32_t a, std::uint32_t b) {
    const auto key = [&](std::uint32_t i) {
      const bool isFoam = all_.kinds[i] == DiffuseKind::Foam;
      return std::tuple(!isFoam, isFoam ? all_.remaining[i] : 0.0F, all_.ids[i]);
    };
    return key(a) < key(b);
  };
  const std::size_t excess = all_.size() - most;
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(excess), order.end(), goesBefore);
  std::vector<std::uint8_t> goes(all_.size(), 0);
  for (std::size_t n = 0; n < excess; ++n) goes[order[n]] = 1;
  removeUnless([&](std::size_t i) { return goes[i] == 0; });
}

template <class Keep>
void FoamParticles::removeUnless(const Keep& keep) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    if (!keep(i)) continue;
    all_.positions[kept] = all_.positions[i];
    all_.velocities[kept] = all_.velocities[i];
    all_.kinds[kept] = all_.kinds[i];
    all_.remaining[kept] = all_.remaining[i];
    all_.ids[kept] = all_.ids[i];
    ++kept;
  }
  all_.positions.resize(kept);
  all_.velocities.resize(kept);
  all_.kinds.resize(kept);
  all_.remaining.resize(kept);
  all_.ids.resize(kept);
}

}  // namespace sluice::sources
