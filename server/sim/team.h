#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <vector>

namespace sluice::sim {

/// Particles are worked on in chunks of this many, whatever the number of threads: sums are taken within a chunk in
/// order and then over the chunks in order, so that they have the same bits for any number of threads. 256 particles
/// with their pairs are about 110 kB, which stays in a core's second-level cache.
inline constexpr std::size_t kChunk = 256;

inline constexpr std::ptrdiff_t kChunksWorthAThread = 4;

struct Chunk {
  std::size_t index;
  std::size_t first;
  std::size_t last;  ///< One past the end.
};

inline std::size_t chunkCount(std::size_t items) { return (items + kChunk - 1) / kChunk; }

/// Runs loops on a fixed number of OpenMP threads.
class Team {
 public:
  explicit Team(int threads) : threads_(threads) {}

  int threads() const { return threads_; }

  /// Calls `work(Chunk)` once for each chunk of [0, items), in parallel; `work` must write to its own chunk only. The
  /// first exception thrown inside (out of memory, say) is thrown again here.
  template <class Work>
  void forEachChunk(std::size_t items, Work&& work) const {
    const auto count = static_cast<std::ptrdiff_t>(chunkCount(items));
    std::exception_ptr failure;
    // A thread with fewer than a few chunks costs more than it brings.
    const int useful = static_cast<int>(std::clamp<std::ptrdiff_t>(count / kChunksWorthAThread, 1, threads_));
#pragma omp parallel for schedule(static) num_threads(useful) if (useful > 1)
    for (std::ptrdiff_t index = 0; index < count; ++index) {
      try {
        const std::size_t first = static_cast<std::size_t>(index) * kChunk;
        work(Chunk{static_cast<std::size_t>(index), first, std::min(first + kChunk, items)});
      } catch (...) {
#pragma omp critical(sluice_sim_team_failure)
        if (!failure) failure = std::current_exception();
      }
    }
    if (failure) std::rethrow_exception(failure);
  }

  /// Adds up `work(Chunk)` over all chunks, in the order of the chunks: operator+= on a default-constructed Result.
  template <class Result, class Work>
  Result sumOverChunks(std::size_t items, Work&& work) const {
    std::vector<Result> partial(chunkCount(items));
    forEachChunk(items, [&](const Chunk& chunk) { partial[chunk.index] = work(chunk); });
    Result total{};
    for (const Result& part : partial) total += part;
    return total;
  }

 private:
  int threads_;
};

}  // namespace sluice::sim
