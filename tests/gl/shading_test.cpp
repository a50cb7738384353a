// The formulas of shared shader files, run on the device and compared.
#include <array>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "sluice/gl/context.h"
#include "sluice/gl/objects.h"
#include "sluice/gl/shader_library.h"

namespace sluice::gl {
namespace {

std::string read(const std::string& name) {
  std::ostringstream text;
  text << std::ifstream(std::string(SLUICE_SOURCE_FOLDER) + "/shaders/" + name).rdbuf();
  return text.str();
}

/// Value of a GLSL expression, after including one of our shader files.
float evaluate(const std::string& file, const std::string& expression) {
  const std::string included = read(file);
  const std::string main = "#include \"" + file + "\"\nout float value;\nvoid main() { value = " + expression + "; }\n";
  const ShaderLibrary library({{"point.vert",
                                "void main() { gl_Position = vec4(vec2((gl_VertexID << 1) & 2, gl_VertexID & 2) * 2.0 "
                                "- 1.0, 0.0, 1.0); }\n"},
                               {"main.frag", main},
                               {file, included}});
  const Program program = library.program("point.vert", "main.frag");
  const Texture texture = makeTexture(GL_R32F, {1, 1});
  const Framebuffer framebuffer = makeFramebuffer(texture);
  const VertexArray array = makeVertexArray();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  glViewport(0, 0, 1, 1);
  glBindVertexArray(array.name());
  glUseProgram(program.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  float value = -1;
  glReadPixels(0, 0, 1, 1, GL_RED, GL_FLOAT, &value);
  return value;
}

TEST(Fresnel, IsTheExactShareForWater) {
  const std::unique_ptr<Context> context = Context::create();
  // Unpolarised reflectance of n = 1.333 by angle, from the closed formula.
  constexpr std::array<std::pair<double, double>, 7> kTable{
      {{0, 0.02037}, {30, 0.02144}, {45, 0.02790}, {60, 0.05969}, {70, 0.13348}, {80, 0.34792}, {85, 0.58352}}};
  for (const auto& [degrees, share] : kTable) {
    const std::string cosine = "cos(radians(" + std::to_string(degrees) + "))";
    EXPECT_NEAR(evaluate("fresnel.glsl", "fresnel(" + cosine + ", 1.333)"), share, 1e-4) << degrees;
  }
}

TEST(Fresnel, NothingIsReflectedWithoutAnInterface) {
  const std::unique_ptr<Context> context = Context::create();
  EXPECT_NEAR(evaluate("fresnel.glsl", "fresnel(0.7, 1.0)"), 0.0, 1e-6);
  EXPECT_NEAR(evaluate("fresnel.glsl", "fresnel(0.0, 1.333)"), 1.0, 1e-6);
}

TEST(Fresnel, InsideIsTotalBeyondTheCriticalAngle) {
  const std::unique_ptr<Context> context = Context::create();
  // asin(1/1.333) = 48.61°.
  EXPECT_EQ(evaluate("fresnel.glsl", "fresnelInside(cos(radians(48.7)), 1.333)"), 1.0F);
  EXPECT_LT(evaluate("fresnel.glsl", "fresnelInside(cos(radians(48.5)), 1.333)"), 0.9F);
  EXPECT_NEAR(evaluate("fresnel.glsl", "fresnelInside(1.0, 1.333)"), 0.02037, 1e-4);
}

TEST(ToneMap, KeepsTheMiddleAndNeverPassesOne) {
  const std::unique_ptr<Context> context = Context::create();
  EXPECT_NEAR(evaluate("tone.glsl", "toneMap(vec3(0.5)).r"), 0.5, 1e-6);
  EXPECT_LE(evaluate("tone.glsl", "toneMap(vec3(1000.0)).r"), 1.0F);
  EXPECT_GT(evaluate("tone.glsl", "toneMap(vec3(1.2)).r"), evaluate("tone.glsl", "toneMap(vec3(1.1)).r"));
}

}  // namespace
}  // namespace sluice::gl
