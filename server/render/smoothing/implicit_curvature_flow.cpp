#include "smoothing/implicit_curvature_flow.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

#include "sluice/core/check.h"
#include "smoothing/flow_rows.h"

namespace sluice::render {

namespace {

RowSpan liquidSpan(const float* q, int width) {
  int first = 0;
  while (first < width && q[first] <= 0.0F) ++first;
  int last = width;
  while (last > first && q[last - 1] <= 0.0F) --last;
  return {first, last};
}

RowAndNeighbours rows(const PaddedField& field, int y) { return {field.row(y - 1), field.row(y), field.row(y + 1)}; }

/// Columns side by side that one thread works on: a few cache lines of every row.
constexpr int kColumns = 64;

/// A length in pixels at inverse depth q. 128 bounds the cost of liquid right before the eye.
int pixels(float length, float q, float pixelSlope) {
  return static_cast<int>(std::min(length * q / pixelSlope, 128.0F));
}

}  // namespace

FlowRow ImplicitCurvatureFlow::flowRow(const Window& window, int y, RowSpan span, const Step& step) const {
  const auto slope = [&](int pixel, int count) {
    return step.pixelSlope * (static_cast<float>(pixel) + 0.5F - 0.5F * static_cast<float>(count));
  };
  return {rows(picture_, y),
          step.oriented == nullptr ? RowAndNeighbours{} : rows(*step.oriented, y),
          span,
          slope(window.left, step.size.width),
          slope(y + window.top, step.size.height),
          step.pixelSlope};
}

FlowTimes flowTimes(const FlowSettings& settings) {
  // Wide enough for splats to merge, narrow enough for the liquid's own shape: a Gaussian of σ = ¾ d.
  constexpr float kMergingDeviation = 0.75F;
  // The end of every line moves by itself, and a long step carries what sets it apart from its neighbours far inside: a
  // last short step, a Gaussian of σ = 0.4 d, evens that out.
  constexpr float kLastDeviation = 0.4F;
  const float squaredSpacing = settings.spacing * settings.spacing;
  const float last = std::min(kLastDeviation * kLastDeviation * squaredSpacing, 0.25F * settings.time);
  return {kMergingDeviation * kMergingDeviation * squaredSpacing,
          (settings.time - last) / static_cast<float>(settings.steps), last};
}

RowSpan ImplicitCurvatureFlow::part(const Window& window, int y, int chunk) {
  const RowSpan span = window.spans[static_cast<std::size_t>(y)];
  const int first = std::max(span.first, chunk * kColumns);
  return {first, std::max(first, std::min(span.last, (chunk + 1) * kColumns))};
}

ImplicitCurvatureFlow::Window ImplicitCurvatureFlow::findLiquid(std::span<const float> q, core::ImageSize size) {
  std::vector<RowSpan> spans(static_cast<std::size_t>(size.height));
  int left = size.width;
  int right = 0;
  int top = size.height;
  int bottom = 0;
  for (int y = 0; y < size.height; ++y) {
    RowSpan& span = spans[static_cast<std::size_t>(y)];
    span = liquidSpan(q.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width), size.width);
    if (span.width() == 0) continue;
    left = std::min(left, span.first);
    right = std::max(right, span.last);
    top = std::min(top, y);
    bottom = y + 1;
  }
  Window window;
  if (top >= bottom) return window;
  window.left = left;
  window.top = top;
  window.width = right - left;
  for (int y = top; y < bottom; ++y) {
    const RowSpan span = spans[static_cast<std::size_t>(y)];
    window.spans.push_back(span.width() == 0 ? RowSpan{} : RowSpan{span.first - left, span.last - left});
  }
  return window;
}

void ImplicitCurvatureFlow::fit(const Window& window) {
  width_ = window.width;
  height_ = window.height();
  for (PaddedField* field : {&picture_, &before_, &after_, &rightSide_}) field->fit(width_, height_);
}

void ImplicitCurvatureFlow::smooth(std::span<float> q, core::ImageSize size, const FlowSettings& settings) {
  SLUICE_CHECK_EQ(q.size(), static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
  Window window = findLiquid(q, size);
  if (window.spans.empty() || settings.time <= 0.0F) return;
  fit(window);
  const auto source = [&](int y) {
    return q.data() + static_cast<std::size_t>(y + window.top) * static_cast<std::size_t>(size.width) + window.left;
  };
  range_ = {std::numeric_limits<float>::max(), 0.0F};
  for (int y = 0; y < height_; ++y) {
    std::copy_n(source(y), width_, picture_.row(y));
    widen(range_, picture_.row(y), window.spans[static_cast<std::size_t>(y)]);
  }
  if (settings.widestGap > 0.0F) closeGaps(window, settings);
  orient(window, settings, size);
  const FlowTimes times = flowTimes(settings);
  Step step{times.step, settings.pixelSlope, settings.edge, settings.spacing, size, &oriented_};
  for (int k = 0; k < settings.steps; ++k) {
    // What one axis does to the lines of the other does not add up when they take turns.
    if (k % 2 == 0) {
      smoothColumns(window, step);
      smoothRows(window, step);
    } else {
      smoothRows(window, step);
      smoothColumns(window, step);
    }
    step.oriented = &picture_;
  }
  step.time = times.last;
  step.oriented = nullptr;
  smoothColumns(window, step);
  smoothRows(window, step);
  for (int y = 0; y < height_; ++y) std::copy_n(picture_.row(y), width_, source(y));
}

void ImplicitCurvatureFlow::closeGaps(Window& window, const FlowSettings& settings) {
  std::vector<float> marks(static_cast<std::size_t>(width_));
  const auto findSpans = [&] {
    for (int y = 0; y < height_; ++y) window.spans[static_cast<std::size_t>(y)] = liquidSpan(picture_.row(y), width_);
  };
  // Gaps that begin in row y, along (dx, dy).
  const auto closeFrom = [&](int y, int dx, int dy) {
    float* const q = picture_.row(y);
    const RowSpan span = window.spans[static_cast<std::size_t>(y)];
    const float length =
        dx != 0 && dy != 0 ? settings.widestGap * std::numbers::sqrt2_v<float> * 0.5F : settings.widestGap;
    markGaps(q, picture_.row(y + dy) + dx, settings.edge, marks.data(), span);
    forEachEnd(marks.data(), span, [&](int i, float) {
      const int roomX = dx == 0 ? height_ + width_ : dx > 0 ? width_ - 1 - i : i;
      const int room = std::min(roomX, dy == 0 ? height_ + width_ : height_ - 1 - y);
      closeGap(q + i, dy * picture_.stride() + dx, std::min(pixels(length, q[i], settings.pixelSlope), room - 1),
               settings.edge);
    });
  };
  // Notches of an outline lie at any angle: with the diagonals no more than 22.5° off one of the four.
  for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(0, 1), std::pair(1, 1), std::pair(-1, 1)}) {
    for (int y = 0; y < height_; ++y) closeFrom(y, dx, dy);
    findSpans();
  }
}

void ImplicitCurvatureFlow::orient(const Window& window, const FlowSettings& settings, core::ImageSize size) {
  oriented_.fit(width_, height_);
  for (int y = 0; y < height_; ++y) std::copy_n(picture_.row(y), width_, oriented_.row(y));
  const Step spread{flowTimes(settings).merging, settings.pixelSlope, settings.edge, settings.spacing, size, nullptr};
  smoothRows(window, spread);
  smoothColumns(window, spread);
  std::swap(oriented_, picture_);
}

void ImplicitCurvatureFlow::smoothRows(const Window& window, const Step& step) {
  // At least a few pixels, for splats that are hardly larger.
  const auto reach = [&](float q) { return std::max(pixels(step.spacing, q, step.pixelSlope), 4); };
#pragma omp parallel
  {
    std::vector<float> ends(static_cast<std::size_t>(width_));
#pragma omp for schedule(static)
    for (int y = 0; y < height_; ++y) {
      const RowSpan span = window.spans[static_cast<std::size_t>(y)];
      const FlowRow row = flowRow(window, y, span, step);
      float* const before = before_.row(y);
      float* const after = after_.row(y);
      float* const rightSide = rightSide_.row(y);
      flowAlongRow(row, step.time, step.edge, before, rightSide, ends.data());
      std::copy(before + span.first, before + span.last, after + span.first);
      forEachEnd(ends.data(), span, [&](int i, float end) {
        if (row.surface.q[i] <= 0.0F) return;
        const float mobility = mobilityAt(row, i, step.time, step.edge).alongX;
        const EndLink link =
            linkEnd(row.surface.q + i, end == kStarts ? 1 : -1, mobility, step.edge, reach(row.surface.q[i]));
        (end == kStarts ? after : before)[i] = link.coefficient;
        rightSide[i] = link.rightSide;
      });
    }

    // Elimination runs along a row, one pixel after another: several rows side by side keep the vector units busy.
    const std::size_t lanes = static_cast<std::size_t>(width_) * kLanes;
    std::vector<float> block(3 * lanes);
    float* const before = block.data();
    float* const after = before + lanes;
    float* const rightSide = after + lanes;
#pragma omp for schedule(static)
    for (int top = 0; top < height_; top += kLanes) {
      const int rows = std::min(kLanes, height_ - top);
      std::ranges::fill(block, 0.0F);
      for (int l = 0; l < rows; ++l) {
        const RowSpan span = window.spans[static_cast<std::size_t>(top + l)];
        for (int i = span.first; i < span.last; ++i) {
          before[i * kLanes + l] = before_.row(top + l)[i];
          after[i * kLanes + l] = after_.row(top + l)[i];
          rightSide[i * kLanes + l] = rightSide_.row(top + l)[i];
        }
      }
      solveInterleavedRows(before, after, rightSide, width_);
      for (int l = 0; l < rows; ++l) {
        const RowSpan span = window.spans[static_cast<std::size_t>(top + l)];
        float* const change = rightSide_.row(top + l);
        for (int i = span.first; i < span.last; ++i) change[i] = rightSide[i * kLanes + l];
        addChange(picture_.row(top + l), change, span, range_);
      }
    }
  }
}

void ImplicitCurvatureFlow::smoothColumns(const Window& window, const Step& step) {
  // At least a few pixels, for splats that are hardly larger.
  const auto reach = [&](float q) { return std::max(pixels(step.spacing, q, step.pixelSlope), 4); };
  const int chunks = (width_ + kColumns - 1) / kColumns;
#pragma omp parallel
  {
    std::vector<float> ends(static_cast<std::size_t>(width_));
#pragma omp for schedule(static)
    for (int chunk = 0; chunk < chunks; ++chunk) {
      const int left = chunk * kColumns;
      const int columns = std::min(kColumns, width_ - left);
      for (int y = 0; y < height_; ++y) {
        float* const before = before_.row(y);
        float* const after = after_.row(y);
        float* const rightSide = rightSide_.row(y);
        // Outside its span a row passes nothing on.
        for (float* values : {before, after, rightSide}) std::fill_n(values + left, columns, 0.0F);
        const RowSpan span = part(window, y, chunk);
        if (span.width() == 0) continue;
        const FlowRow row = flowRow(window, y, span, step);
        flowAlongColumn(row, step.time, step.edge, before, rightSide, ends.data());
        std::copy(before + span.first, before + span.last, after + span.first);
        forEachEnd(ends.data(), span, [&](int i, float end) {
          if (row.surface.q[i] <= 0.0F) return;
          const float mobility = mobilityAt(row, i, step.time, step.edge).alongY;
          const std::ptrdiff_t inwards = end == kStarts ? picture_.stride() : -picture_.stride();
          const EndLink link = linkEnd(row.surface.q + i, inwards, mobility, step.edge, reach(row.surface.q[i]));
          (end == kStarts ? after : before)[i] = link.coefficient;
          rightSide[i] = link.rightSide;
        });
        eliminateDown(after_.row(y - 1), rightSide_.row(y - 1), before, after, rightSide, span.first, span.last);
      }
    }
#pragma omp for schedule(static)
    for (int chunk = 0; chunk < chunks; ++chunk) {
      for (int y = height_ - 1; y >= 0; --y) {
        const RowSpan span = part(window, y, chunk);
        substituteUp(after_.row(y), rightSide_.row(y), rightSide_.row(y + 1), span.first, span.last);
        addChange(picture_.row(y), rightSide_.row(y), span, range_);
      }
    }
  }
}

}  // namespace sluice::render
