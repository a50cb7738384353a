#include <algorithm>
#include <array>

#include "body_passes.h"
#include "pack.h"

namespace sluice::render {

namespace {

using Eigen::Vector3f;

struct PaneVertex {
  Vector3f position;
  Vector3f normal;
  std::array<float, 4> glass;  ///< Tint; refractive index.
};

struct RimPiece {
  Vector3f start;
  Vector3f end;
  std::array<float, 4> glass;
  float width;
};

std::array<float, 4> glassOf(const BodyInstance& body) {
  return pack(body.body.glass().tint(), body.body.glass().refractive_index());
}

/// All triangles, the farthest first.
std::vector<std::array<PaneVertex, 3>> sortedPanes(const BodyScene& bodies, const ViewGeometry& view) {
  std::vector<std::array<PaneVertex, 3>> panes;
  for (const BodyInstance& body : bodies.bodies()) {
    if (!body.isGlass()) continue;
    const std::array<float, 4> glass = glassOf(body);
    const auto placed = [&](std::uint32_t index) {
      const BodyVertex& vertex = body.model->mesh.vertices[index];
      return PaneVertex{body.pose * vertex.position, body.pose.linear() * vertex.normal, glass};
    };
    for (const auto& [a, b, c] : body.model->mesh.triangles) panes.push_back({placed(a), placed(b), placed(c)});
  }
  const auto distance = [&](const std::array<PaneVertex, 3>& pane) {
    return (pane[0].position + pane[1].position + pane[2].position - 3.0F * view.eye).squaredNorm();
  };
  std::ranges::stable_sort(panes, std::ranges::greater{}, distance);
  return panes;
}

std::vector<RimPiece> rimsOf(const BodyScene& bodies) {
  std::vector<RimPiece> rims;
  for (const BodyInstance& body : bodies.bodies()) {
    if (!body.isGlass()) continue;
    // As thick as panes of a tank are: a two-hundredth of its size.
    const float width = 0.005F * boundsOf(body).radius;
    for (const BodyRim& rim : body.model->mesh.rims) {
      for (std::size_t i = 0; i + 1 < rim.size(); ++i) {
        rims.push_back({body.pose * rim[i], body.pose * rim[i + 1], glassOf(body), width});
      }
    }
  }
  return rims;
}

void attribute(GLuint index, GLint size, GLsizei stride, std::size_t offset, GLuint divisor) {
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, stride, reinterpret_cast<const void*>(offset));
  glVertexAttribDivisor(index, divisor);
}

const gl::Program& find(std::map<std::set<std::string_view>, gl::Program>& programs, std::string_view vertexShader,
                        const std::set<std::string_view>& defines) {
  auto program = programs.find(defines);
  if (program == programs.end()) {
    const std::vector<std::string_view> names(defines.begin(), defines.end());
    program = programs.emplace(defines, shaders().program(vertexShader, "glass.frag", names)).first;
  }
  return program->second;
}

}  // namespace

void GlassPass::runBehind(const FrameContext& frame, const BodyScene& bodies) {
  if (!frame.plan.runs(Pass::Sunlight)) copy(frame, Resource::Background, Resource::Scene);
  draw(frame, bodies, Resource::Scene, false);
}

void GlassPass::runBefore(const FrameContext& frame, const BodyScene& bodies) {
  draw(frame, bodies, Resource::Picture, true);
}

void GlassPass::draw(const FrameContext& frame, const BodyScene& bodies, Resource into, bool before) {
  const std::vector<std::array<PaneVertex, 3>> panes = sortedPanes(bodies, frame.view);
  const std::vector<RimPiece> rims = rimsOf(bodies);
  std::set<std::string_view> defines = liquidFrontDefines(frame);
  if (before) defines.insert("BEFORE");

  beginTarget(frame, into);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_SRC1_COLOR);
  glEnable(GL_CLIP_DISTANCE0);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);

  const gl::VertexArray array = gl::makeVertexArray();
  glBindVertexArray(array.name());
  const gl::Program& paneProgram = find(panes_, "glass.vert", defines);
  bindLiquidFront(frame, paneProgram);
  paneVertices_.upload(std::as_bytes(std::span(panes)));
  glBindBuffer(GL_ARRAY_BUFFER, paneVertices_.name());
  attribute(0, 3, sizeof(PaneVertex), offsetof(PaneVertex, position), 0);
  attribute(1, 3, sizeof(PaneVertex), offsetof(PaneVertex, normal), 0);
  attribute(2, 4, sizeof(PaneVertex), offsetof(PaneVertex, glass), 0);
  glUseProgram(paneProgram.name());
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(3 * panes.size()));

  if (!rims.empty()) {
    defines.insert("RIM");
    const gl::Program& rimProgram = find(rims_, "glass_rim.vert", defines);
    bindLiquidFront(frame, rimProgram);
    rimVertices_.upload(std::as_bytes(std::span(rims)));
    glBindBuffer(GL_ARRAY_BUFFER, rimVertices_.name());
    attribute(0, 3, sizeof(RimPiece), offsetof(RimPiece, start), 1);
    attribute(1, 3, sizeof(RimPiece), offsetof(RimPiece, end), 1);
    attribute(2, 4, sizeof(RimPiece), offsetof(RimPiece, glass), 1);
    attribute(3, 1, sizeof(RimPiece), offsetof(RimPiece, width), 1);
    glUseProgram(rimProgram.name());
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(rims.size()));
  }
  glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  glDisable(GL_CLIP_DISTANCE0);
}

}  // namespace sluice::render
