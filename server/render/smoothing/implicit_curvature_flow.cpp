#include "smoothing/implicit_curvature_flow.h"

#include <algorithm>

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

FlowRow flowRow(const PaddedField& picture, int y, RowSpan span, int left, int top, float pixelSlope,
                core::ImageSize size) {
  const float middleX = 0.5F * static_cast<float>(size.width);
  const float middleY = 0.5F * static_cast<float>(size.height);
  return {picture.row(y - 1),
          picture.row(y),
          picture.row(y + 1),
          span,
          pixelSlope * (static_cast<float>(left) + 0.5F - middleX),
          pixelSlope * (static_cast<float>(y + top) + 0.5F - middleY),
          pixelSlope};
}

}  // namespace

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
  picture_ = PaddedField(width_, height_);
  coefficient_ = PaddedField(width_, height_);
  rightSide_ = PaddedField(width_, height_);
  block_.assign(2 * static_cast<std::size_t>(width_) * kLanes, 0.0F);
}

void ImplicitCurvatureFlow::smooth(std::span<float> q, core::ImageSize size, const FlowSettings& settings) {
  SLUICE_CHECK_EQ(q.size(), static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
  const Window window = findLiquid(q, size);
  if (window.spans.empty() || settings.time <= 0.0F) return;
  fit(window);
  const auto source = [&](int y) {
    return q.data() + static_cast<std::size_t>(y + window.top) * static_cast<std::size_t>(size.width) + window.left;
  };
  for (int y = 0; y < height_; ++y) std::copy_n(source(y), width_, picture_.row(y));
  const float timeStep = settings.time / static_cast<float>(settings.steps);
  for (int step = 0; step < settings.steps; ++step) {
    smoothRows(window, settings, size, timeStep);
    smoothColumns(window, settings, size, timeStep);
  }
  for (int y = 0; y < height_; ++y) std::copy_n(picture_.row(y), width_, source(y));
}

void ImplicitCurvatureFlow::smoothRows(const Window& window, const FlowSettings& settings, core::ImageSize size,
                                       float timeStep) {
  for (int y = 0; y < height_; ++y) {
    const RowSpan span = window.spans[static_cast<std::size_t>(y)];
    flowAlongRow(flowRow(picture_, y, span, window.left, window.top, settings.pixelSlope, size), timeStep,
                 settings.edge, coefficient_.row(y), rightSide_.row(y));
  }
  // Elimination runs along a row, one pixel after another: several rows side by side keep the vector units busy.
  float* const c = block_.data();
  float* const b = c + static_cast<std::size_t>(width_) * kLanes;
  for (int top = 0; top < height_; top += kLanes) {
    const int rows = std::min(kLanes, height_ - top);
    std::fill(block_.begin(), block_.end(), 0.0F);
    for (int l = 0; l < rows; ++l) {
      const RowSpan span = window.spans[static_cast<std::size_t>(top + l)];
      const float* const coefficients = coefficient_.row(top + l);
      const float* const rightSides = rightSide_.row(top + l);
      for (int i = span.first; i < span.last; ++i) {
        c[i * kLanes + l] = coefficients[i];
        b[i * kLanes + l] = rightSides[i];
      }
    }
    solveInterleavedRows(c, b, width_);
    for (int l = 0; l < rows; ++l) {
      const RowSpan span = window.spans[static_cast<std::size_t>(top + l)];
      float* const change = rightSide_.row(top + l);
      for (int i = span.first; i < span.last; ++i) change[i] = b[i * kLanes + l];
      addChange(picture_.row(top + l), change, span);
    }
  }
}

void ImplicitCurvatureFlow::smoothColumns(const Window& window, const FlowSettings& settings, core::ImageSize size,
                                          float timeStep) {
  for (int y = 0; y < height_; ++y) {
    // Outside its span a row passes nothing on.
    std::fill_n(coefficient_.row(y), width_, 0.0F);
    std::fill_n(rightSide_.row(y), width_, 0.0F);
    const RowSpan span = window.spans[static_cast<std::size_t>(y)];
    flowAlongColumn(flowRow(picture_, y, span, window.left, window.top, settings.pixelSlope, size), timeStep,
                    settings.edge, coefficient_.row(y), rightSide_.row(y));
    eliminateDown(coefficient_.row(y - 1), rightSide_.row(y - 1), coefficient_.row(y), rightSide_.row(y), span.first,
                  span.last);
  }
  for (int y = height_ - 1; y >= 0; --y) {
    const RowSpan span = window.spans[static_cast<std::size_t>(y)];
    substituteUp(coefficient_.row(y), rightSide_.row(y), rightSide_.row(y + 1), span.first, span.last);
    addChange(picture_.row(y), rightSide_.row(y), span);
  }
}

}  // namespace sluice::render
