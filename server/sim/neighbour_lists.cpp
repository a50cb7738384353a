#include "neighbour_lists.h"

#include <algorithm>

namespace sluice::sim {

namespace {

// Far enough that no kernel reaches, near enough that its square is a float.
constexpr float kFar = 1e18F;
constexpr std::uint32_t kNoIndex = 0xFFFFFFFFU;
// Pairs of a particle deep in a fluid, in groups, with some to spare: 30 neighbours and the rounding up to fours.
constexpr std::size_t kUsualGroups = 8;

/// The storage behind Candidates, kept from cell to cell.
class CandidateBuffer {
 public:
  /// Copies the points of a neighbourhood; `extra(slot, point)` fills in what else is wanted.
  template <class Extra>
  void gather(const CellGrid::Neighbourhood& around, const std::vector<Float4>& points, const Float4& period,
              Extra&& extra) {
    reserve(around.points);
    count_ = 0;
    for (std::size_t r = 0; r < static_cast<std::size_t>(around.count); ++r) {
      const CellGrid::Range& range = around.ranges[r];
      const float x = range.image[0] * period.x;
      const float y = range.image[1] * period.y;
      const float z = range.image[2] * period.z;
      for (std::uint32_t j = range.first; j < range.last; ++j, ++count_) {
        x_[count_] = points[j].x + x;
        y_[count_] = points[j].y + y;
        z_[count_] = points[j].z + z;
        extra(count_, j);
      }
    }
    pad();
  }

  void setVolume(std::size_t slot, float volume) { volume_[slot] = volume; }
  void setIndex(std::size_t slot, std::uint32_t index) { index_[slot] = index; }

  Candidates view() { return {x_.data(), y_.data(), z_.data(), volume_.data(), index_.data(), slots_.data(), count_}; }

 private:
  static constexpr std::size_t kLanes = Candidates::kLanes;

  static std::size_t padded(std::size_t count) { return (count + kLanes - 1) / kLanes * kLanes + kLanes; }

  void reserve(std::size_t points) {
    if (x_.size() >= padded(points)) return;
    for (std::vector<float>* values : {&x_, &y_, &z_, &volume_}) values->resize(padded(points));
    index_.resize(padded(points));
    slots_.resize(padded(points));
  }

  void pad() {
    for (std::size_t slot = count_; slot < padded(count_); ++slot) {
      x_[slot] = y_[slot] = z_[slot] = kFar;
      volume_[slot] = 0;
      index_[slot] = kNoIndex;
    }
  }

  std::vector<float> x_, y_, z_, volume_;
  std::vector<std::uint32_t> index_;
  std::vector<std::uint32_t> slots_;
  std::size_t count_ = 0;
};

/// Calls `action(cell, first, last)` for each run of a chunk's particles that share a cell.
template <class Action>
void forEachCell(const Chunk& chunk, const std::vector<std::uint32_t>& cellOf, Action&& action) {
  for (std::size_t first = chunk.first; first < chunk.last;) {
    const std::uint32_t cell = cellOf[first];
    std::size_t last = first + 1;
    while (last < chunk.last && cellOf[last] == cell) ++last;
    action(cell, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last));
    first = last;
  }
}

}  // namespace

PairSums NeighbourLists::sums() {
  return {density_.data(), gradientSum_.data(), gradientSquares_.data(), groupCount_.data(), neighbours_.data()};
}

void NeighbourLists::find(const CellGrid& grid, const std::vector<Float4>& positions, const Team& team) {
  const std::size_t particles = positions.size();
  groups_.resize(chunkCount(particles));
  wallContacts_.resize(chunkCount(particles));
  groupCount_.resize(particles);
  neighbours_.resize(particles);
  density_.resize(particles);
  gradientSum_.resize(particles);
  gradientSquares_.resize(particles);

  team.forEachChunk(particles, [&](const Chunk& chunk) {
    thread_local CandidateBuffer buffer;
    wallContacts_[chunk.index].clear();
    std::vector<PairGroup>& groups = groups_[chunk.index];
    if (groups.empty()) groups.resize(kUsualGroups * (chunk.last - chunk.first));
    std::size_t used = 0;
    forEachCell(chunk, grid.cellOfSorted(), [&](std::uint32_t cell, std::uint32_t first, std::uint32_t last) {
      buffer.gather(grid.around(cell), positions, scale_.period,
                    [&](std::size_t slot, std::uint32_t j) { buffer.setIndex(slot, j); });
      const Candidates candidates = buffer.view();
      // Particle by particle, because the room that all of a cell might need is a multiple of what they do need.
      const std::size_t room = candidates.count / 4 + 5;
      for (std::uint32_t i = first; i < last; ++i) {
        if (used + room > groups.size()) {
          const std::size_t size = groups.size() + groups.size() / 16 + room;
          groups.reserve(size);  // just that, where resize() alone would make room for twice as many
          groups.resize(size);
        }
        const PairGroup* end =
            loops_->findNeighbours(scale_, candidates, positions.data(), i, i + 1, groups.data() + used, sums());
        used = static_cast<std::size_t>(end - groups.data());
      }
    });
  });
}

void NeighbourLists::addBoundary(const Boundary& boundary, WallAnswer answer, const CellGrid& grid,
                                 const std::vector<Float4>& positions, const Team& team) {
  team.forEachChunk(positions.size(), [&](const Chunk& chunk) {
    thread_local CandidateBuffer buffer;
    thread_local std::vector<WallSums> walls;
    thread_local std::vector<WallContact> contacts;
    contacts.clear();
    forEachCell(chunk, grid.cellOfSorted(), [&](std::uint32_t cell, std::uint32_t first, std::uint32_t last) {
      const CellGrid::Neighbourhood around = boundary.grid().around(cell);
      if (around.points == 0) return;
      buffer.gather(around, boundary.points(), scale_.period,
                    [&](std::size_t slot, std::uint32_t b) { buffer.setVolume(slot, boundary.volumes()[b]); });
      if (answer == WallAnswer::Once) {
        loops_->addBoundary(scale_, buffer.view(), positions.data(), first, last, sums());
        return;
      }
      walls.resize(last - first);
      loops_->weighBoundary(scale_, buffer.view(), positions.data(), first, last, sums(), walls.data());
      for (std::uint32_t i = first; i < last; ++i) addMirror(walls[i - first], i, contacts);
    });
    wallContacts_[chunk.index].assign(contacts.begin(), contacts.end());  // no more room than they need
  });
}

void NeighbourLists::addMirror(const WallSums& wall, std::uint32_t i, std::vector<WallContact>& contacts) {
  const Float4& once = wall.gradient;
  if (once.x == 0 && once.y == 0 && once.z == 0) return;
  const float times = wallMirror(density_[i]);
  contacts.push_back(wallContact(i, wall, times));
  Float4& sum = gradientSum_[i];
  sum = {sum.x + times * once.x, sum.y + times * once.y, sum.z + times * once.z, 0};
}

void NeighbourLists::countFluidNeighbours(const Chunk& chunk, std::vector<std::uint16_t>& counts) const {
  const PairGroup* group = groups_[chunk.index].data();
  for (std::size_t i = chunk.first; i < chunk.last; ++i) {
    const std::size_t places = 4 * std::size_t{groupCount_[i]};
    std::size_t others = places;
    // The last group is filled up with the particle itself.
    if (places > 0) {
      group += groupCount_[i];
      for (const std::uint32_t neighbour : group[-1].neighbour) others -= neighbour == i ? 1 : 0;
    }
    counts[i] = static_cast<std::uint16_t>(others);
  }
}

std::uint64_t NeighbourLists::bytes() const {
  std::uint64_t total = 0;
  for (const std::vector<PairGroup>& groups : groups_) total += groups.capacity() * sizeof(PairGroup);
  for (const std::vector<WallContact>& contacts : wallContacts_) total += contacts.capacity() * sizeof(WallContact);
  return total + groupCount_.size() * (2 * sizeof(std::uint16_t) + 2 * sizeof(float) + sizeof(Float4));
}

}  // namespace sluice::sim
