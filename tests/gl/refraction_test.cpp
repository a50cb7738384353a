// The refraction of shared shader files against closed formulas, for a surface that is known exactly.
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <vector>

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

/// View space is the world turned upside down: y goes down in the one, up in the other. A floor at `floorHeight`.
std::string surroundings(double floorHeight, const std::string& absorption) {
  return "struct Frame { vec4 pictureSlopes; vec4 floorAndHaze; vec4 pictureSize; vec4 forwardAndPixel; };\n"
         "const Frame frame = Frame(vec4(1.0), vec4(" +
         std::to_string(floorHeight) +
         ", 1.0, 1.0, 15.0), vec4(1024.0, 1024.0, 1.0 / 1024.0, 1.0 / 1024.0), vec4(0.0, 0.0, 1.0, 2.0 / 1024.0));\n"
         "struct Liquid { vec4 absorptionAndIndex; vec4 scatterAndShift; vec4 slopes; vec4 splat; };\n"
         "const Liquid liquid = Liquid(vec4(" +
         absorption +
         ", 1.333), vec4(0.0), vec4(1.0), vec4(0.1));\n"
         "vec3 toWorldDirection(vec3 v) { return vec3(v.x, -v.y, v.z); }\n"
         "vec3 lightBelow(vec3 point, vec3 normal, float spread) { return vec3(1.0); }\n";
}

/// Red of an expression of clear_body.glsl, over a scene of 1024 rows whose radiance is that of `row`.
float evaluate(const std::string& around, const std::string& expression, float (*row)(float)) {
  // The library refers to texts; it does not own them.
  const std::string main =
      around + "#include \"fresnel.glsl\"\n#include \"picture_place.glsl\"\n" +
      "#include \"refraction.glsl\"\n#include \"clear_body.glsl\"\nout float value;\nvoid main() { value = " +
      expression + "; }\n";
  const std::string fresnel = read("fresnel.glsl");
  const std::string place = read("picture_place.glsl");
  const std::string refraction = read("refraction.glsl");
  const std::string clearBody = read("clear_body.glsl");
  const ShaderLibrary library(
      {{"point.vert",
        "void main() { gl_Position = vec4(vec2((gl_VertexID << 1) & 2, gl_VertexID & 2) * 2.0 - 1.0, "
        "0.0, 1.0); }\n"},
       {"main.frag", main},
       {"fresnel.glsl", fresnel},
       {"picture_place.glsl", place},
       {"refraction.glsl", refraction},
       {"two_interfaces.glsl", "\n"},
       {"clear_body.glsl", clearBody}});
  const Program program = library.program("point.vert", "main.frag");
  constexpr int kRows = 1024;
  std::vector<float> rows(kRows);
  for (int i = 0; i < kRows; ++i) rows[static_cast<std::size_t>(i)] = row((static_cast<float>(i) + 0.5F) / kRows);
  const Texture scene = makeTexture(GL_R32F, {1, kRows});
  setBilinear(scene);
  glTextureSubImage2D(scene.name(), 0, 0, 0, 1, kRows, GL_RED, GL_FLOAT, rows.data());
  glBindTextureUnit(1, scene.name());
  const Texture target = makeTexture(GL_R32F, {1, 1});
  const Framebuffer framebuffer = makeFramebuffer(target);
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

TEST(Refraction, ShiftOfAFlatSlabIsThatOfSnellsLaw) {
  const std::unique_ptr<Context> context = Context::create();
  constexpr double kIndex = 1.333;
  constexpr double kSlab = 0.3;    // t, m
  constexpr double kFloor = -2.0;  // m below the eye
  for (const double degrees : {5.0, 20.0, 40.0, 55.0, 70.0}) {
    // The line of sight goes down by 30°; the slab's normal is turned further by the angle of incidence.
    const double down = std::numbers::pi / 6;
    const double in = degrees * std::numbers::pi / 180;
    const double refracted = std::asin(std::sin(in) / kIndex);
    const double sy = std::sin(down);
    const double sz = std::cos(down);
    const double ny = -std::sin(down - in);
    const double nz = -std::cos(down - in);
    // Where it comes in, 1 m from the eye, and leaves: sideways by t·sin(θi − θt)/cos θt, towards the slab's inside.
    const double shift = kSlab * std::sin(in - refracted) / std::cos(refracted);
    const double sideY = -sz;
    const double sideZ = sy;
    const double along = (-kFloor - (sy + shift * sideY)) / sy;  // from the shifted entry to the floor
    const double y = sy + shift * sideY + along * sy;
    const double z = sz + shift * sideZ + along * sz;
    std::ostringstream entry;
    entry.precision(9);
    entry << std::fixed << "transmitted(Entry(vec3(0.0, " << sy << ", " << sz << "), vec3(0.0, " << sy << ", " << sz
          << "), vec3(0.0, " << ny << ", " << nz << "), " << std::cos(in) << ", " << std::cos(in) << ", "
          << kSlab / std::cos(in) << ", vec2(0.0, " << sy / sz << "), vec3(0.0, " << -sy << ", " << sz
          << "))).radiance.r";
    const float place = evaluate(surroundings(kFloor, "0.0, 0.0, 0.0"), entry.str(), [](float at) { return at; });
    EXPECT_NEAR(place, 0.5 + 0.5 * y / z, 0.5 / 1024) << degrees;
    // The test can fail: without the slab the place is another.
    EXPECT_GT(std::abs(0.5 + 0.5 * y / z - (0.5 + 0.5 * sy / sz)), degrees < 10 ? 0 : 2.0 / 1024) << degrees;
  }
}

TEST(Refraction, AttenuationOfAKnownThicknessIsBeerLamberts) {
  const std::unique_ptr<Context> context = Context::create();
  for (const double thickness : {0.0, 0.05, 0.4, 2.0}) {
    const std::string entry =
        "clearBody(Entry(vec3(0.0, 0.0, 1.0), vec3(0.0, 0.0, 1.0), vec3(0.0, 0.0, -1.0), 1.0, 1.0, " +
        std::to_string(thickness) + ", vec2(0.0), vec3(0.0, 0.0, 1.0)), vec3(0.0, 1.0, 0.0)).r";
    const float left = evaluate(surroundings(-1e4, "2.6, 0.75, 0.45"), entry, [](float) { return 1.0F; });
    EXPECT_NEAR(left, std::exp(-2.6 * thickness), 0.5 / 255) << thickness;
  }
}

}  // namespace
}  // namespace sluice::gl
