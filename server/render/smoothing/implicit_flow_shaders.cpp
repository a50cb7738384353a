#include "smoothing/implicit_flow_shaders.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

namespace sluice::render {

namespace {

constexpr Resource kOriented = kSurfaceScratch[0];
constexpr Resource kBefore = kSurfaceScratch[1];
constexpr Resource kAfter = kSurfaceScratch[2];
constexpr Resource kRightSide = kSurfaceScratch[3];

gl::Program variant(std::string_view stage) {
  return shaders().computeProgram("implicit_curvature_flow.comp", std::array{stage});
}

/// As many groups of `threads` as `count` needs.
GLuint groups(int count, int threads) { return static_cast<GLuint>((count + threads - 1) / threads); }

void bindImage(const FrameContext& frame, GLuint binding, Resource resource) {
  // Asking for the framebuffer says that the device's content is the newest.
  frame.targets.framebuffer(resource);
  glBindImageTexture(binding, frame.targets.texture(resource).name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32F);
}

void waitForImages() { glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT); }

}  // namespace

ImplicitFlowShaders::ImplicitFlowShaders()
    : range_(variant("RANGE")), closeGaps_(variant("CLOSE_GAPS")), link_(variant("LINK")), solve_(variant("SOLVE")) {}

void ImplicitFlowShaders::run(const FrameContext& frame, const FlowSettings& settings) {
  for (const gl::Program* program : {&range_, &closeGaps_, &link_, &solve_}) {
    glProgramUniform1f(program->name(), 1, settings.edge);
  }
  glProgramUniform1f(link_.name(), 3, settings.spacing);
  glProgramUniform1f(closeGaps_.name(), 4, settings.widestGap);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, frame.surfaceUniforms);

  findRange(frame);
  if (settings.widestGap > 0.0F) {
    for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(0, 1), std::pair(1, 1), std::pair(-1, 1)}) {
      closeGaps(frame, dx, dy);
    }
  }
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
  copy(frame, Resource::Surface, kOriented);
  const FlowTimes times = flowTimes(settings);
  solve(frame, kOriented, nullptr, Axis::Rows, times.merging);
  solve(frame, kOriented, nullptr, Axis::Columns, times.merging);
  const Resource* oriented = &kOriented;
  const Resource itself = Resource::Surface;
  for (int k = 0; k < settings.steps; ++k) {
    const Axis first = k % 2 == 0 ? Axis::Columns : Axis::Rows;
    const Axis second = k % 2 == 0 ? Axis::Rows : Axis::Columns;
    solve(frame, Resource::Surface, oriented, first, times.step);
    solve(frame, Resource::Surface, oriented, second, times.step);
    oriented = &itself;
  }
  solve(frame, Resource::Surface, nullptr, Axis::Columns, times.last);
  solve(frame, Resource::Surface, nullptr, Axis::Rows, times.last);
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
}

void ImplicitFlowShaders::findRange(const FrameContext& frame) {
  const std::array<std::uint32_t, 2> none{std::bit_cast<std::uint32_t>(std::numeric_limits<float>::max()), 0U};
  rangeBuffer_.upload(std::as_bytes(std::span(none)));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, rangeBuffer_.name());
  bindImage(frame, 0, Resource::Surface);
  glUseProgram(range_.name());
  glDispatchCompute(groups(frame.surfaceView.size.height, 32), 1, 1);
  waitForImages();
}

void ImplicitFlowShaders::closeGaps(const FrameContext& frame, int dx, int dy) const {
  const core::ImageSize size = frame.surfaceView.size;
  bindImage(frame, 0, Resource::Surface);
  glUseProgram(closeGaps_.name());
  glProgramUniform2i(closeGaps_.name(), 0, dx, dy);
  glDispatchCompute(groups(dy == 0 ? size.height : size.width + size.height - 1, 32), 1, 1);
  waitForImages();
}

void ImplicitFlowShaders::solve(const FrameContext& frame, Resource picture, const Resource* oriented, Axis axis,
                                float time) const {
  const core::ImageSize size = frame.surfaceView.size;
  bindImage(frame, 0, picture);
  bindImage(frame, 1, oriented == nullptr ? picture : *oriented);
  bindImage(frame, 2, kBefore);
  bindImage(frame, 3, kAfter);
  bindImage(frame, 4, kRightSide);
  for (const gl::Program* program : {&link_, &solve_}) {
    glProgramUniform2i(program->name(), 0, axis == Axis::Rows ? 1 : 0, axis == Axis::Rows ? 0 : 1);
  }
  glProgramUniform1f(link_.name(), 2, time);
  glProgramUniform1i(link_.name(), 5, oriented == nullptr ? 0 : 1);
  glUseProgram(link_.name());
  glDispatchCompute(groups(size.width, 16), groups(size.height, 16), 1);
  waitForImages();
  glUseProgram(solve_.name());
  glDispatchCompute(groups(axis == Axis::Rows ? size.height : size.width, 32), 1, 1);
  waitForImages();
}

}  // namespace sluice::render
