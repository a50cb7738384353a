#include <gmock/gmock.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "frame_uniforms.h"
#include "liquid_uniforms.h"
#include "sluice/gl/shader_library.h"

namespace sluice::render {
namespace {

std::string read(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// Names of the vec4 members in a declaration, in order.
std::vector<std::string> members(std::string text, const std::string& block, const std::string& type) {
  text = text.substr(text.find(block + " {"));
  text = text.substr(0, text.find("\n}"));
  std::vector<std::string> names;
  const std::regex member("\\n  " + type + " (\\w+);");
  for (std::sregex_iterator i(text.begin(), text.end(), member), end; i != end; ++i) names.push_back((*i)[1]);
  return names;
}

/// Compares a block's members in a shader file with those in a header, whose struct has `size` bytes.
void expectMirrored(const std::string& block, const std::string& stem, std::size_t size) {
  const std::string root = SLUICE_SOURCE_FOLDER;
  const auto glsl = members(read(root + "/shaders/" + stem + ".glsl"), block, "vec4");
  const auto cpp = members(read(root + "/server/render/" + stem + ".h"), block, "Vec4");
  ASSERT_FALSE(glsl.empty());
  EXPECT_EQ(glsl, cpp);
  EXPECT_EQ(size, 16 * cpp.size());
}

TEST(FrameUniforms, MirrorTheShaders) { expectMirrored("FrameUniforms", "frame_uniforms", sizeof(FrameUniforms)); }

TEST(LiquidUniforms, MirrorTheShaders) { expectMirrored("LiquidUniforms", "liquid_uniforms", sizeof(LiquidUniforms)); }

TEST(ShaderLibrary, PutsEachIncludeInOnce) {
  const gl::ShaderLibrary library({{"a.frag", "#include \"b.glsl\"\n#include \"c.glsl\"\nmain\n"},
                                   {"b.glsl", "#include \"c.glsl\"\nb\n"},
                                   {"c.glsl", "c\n"}});
  const std::array defines{std::string_view("FLAG")};
  const gl::ExpandedShader shader = library.expand("a.frag", defines);
  EXPECT_EQ(shader.text, "#version 450 core\n#define FLAG 1\nc\nb\nmain\n");
  ASSERT_EQ(shader.places.size(), 5U);
  EXPECT_EQ(shader.places[3].file, "b.glsl");
  EXPECT_EQ(shader.places[3].line, 2);
  EXPECT_EQ(shader.places[4].line, 3);
}

TEST(ShaderLibrary, NamesThePlaceOfAnError) {
  const gl::ShaderLibrary library({{"a.frag", "#include \"b.glsl\"\nmain\n"}, {"b.glsl", "first\nsecond\n"}});
  const gl::ExpandedShader shader = library.expand("a.frag", {});
  EXPECT_EQ(gl::namePlaces("0:3(7): error: no", shader), "b.glsl:2: (7): error: no");
  EXPECT_EQ(gl::namePlaces("0(4) : error C1: no", shader), "a.frag:2:  : error C1: no");
  EXPECT_EQ(gl::namePlaces("linker says no", shader), "linker says no");
}

TEST(ShaderLibrary, RefusesAnUnknownFile) {
  EXPECT_THROW(gl::ShaderLibrary({}).expand("missing.frag", {}), gl::ShaderError);
}

}  // namespace
}  // namespace sluice::render
