// Normals of meshes that come without: differences of the depth in the picture are those of the faces.
#include <unistd.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <array>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "render_test.h"

namespace sluice::testing {
namespace {

using Eigen::Vector3f;

constexpr double kDegrees = std::numbers::pi / 180;

class MeshNormals : public RenderTest {
 protected:
  MeshNormals() {
    std::filesystem::create_directories(folder_);
    background.set_floor(false);
    v1::Body& body = *scene.add_bodies();
    body.mutable_position()->set_z(-3);
    body.mutable_rotation_degrees()->set_x(kTurnX);
    body.mutable_rotation_degrees()->set_y(kTurnY);
    body.mutable_mesh()->set_path(writeOctahedron("shared.obj", false));
    scene::complete(scene);
  }
  ~MeshNormals() override { std::filesystem::remove_all(folder_); }

  v1::Body& body() { return *scene.mutable_bodies(0); }
  std::vector<float> draw() {
    render(cloud({}, 0.05), alongZ(), size);
    return renderer.readRadiance().values;
  }

  /// |x| + |y| + |z| = 1. Its six corners are shared by faces, or each face has three of its own with its normal.
  std::string writeOctahedron(const std::string& name, bool flat) const {
    const std::string path = folder_ / name;
    std::ofstream file(path);
    int corner = 0;
    const auto write = [&](const Vector3f& p) { file << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n'; };
    if (!flat) {
      for (const float side : {1.0F, -1.0F}) {
        for (int axis = 0; axis < 3; ++axis) write(side * Vector3f::Unit(axis));
      }
    }
    for (const Vector3f& normal : faces()) {
      std::array<int, 3> axes{0, 1, 2};
      if (normal.prod() < 0) axes = {0, 2, 1};  // counter-clockwise from outside
      std::string line = "f";
      if (flat) file << "vn " << normal.x() << ' ' << normal.y() << ' ' << normal.z() << '\n';
      for (const int axis : axes) {
        if (flat) {
          write(std::copysign(1.0F, normal[axis]) * Vector3f::Unit(axis));
          ++corner;
          line += ' ' + std::to_string(corner) + "//" + std::to_string((corner + 2) / 3);
        } else {
          line += ' ' + std::to_string(1 + axis + (normal[axis] < 0 ? 3 : 0));
        }
      }
      file << line << '\n';
    }
    return path;
  }

  /// The eight directions (±1, ±1, ±1)/√3.
  static std::vector<Vector3f> faces() {
    std::vector<Vector3f> all;
    for (const float x : {1.0F, -1.0F}) {
      for (const float y : {1.0F, -1.0F}) {
        for (const float z : {1.0F, -1.0F}) all.push_back(Vector3f(x, y, z).normalized());
      }
    }
    return all;
  }

  static constexpr float kTurnX = 25;
  static constexpr float kTurnY = 35;
  core::ImageSize size{200, 200};

 private:
  /// Tests run side by side, each in a process of its own.
  std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) / ("sluice_mesh_normals_" + std::to_string(::getpid()));
};

TEST_F(MeshNormals, FromThePictureAreThoseOfTheFaces) {
  // Read off the picture by photometric stereo: of white plaster in the light of one sun alone, radiance is n·s.
  background.mutable_uniform()->mutable_radiance()->set_x(0);
  background.mutable_uniform()->mutable_radiance()->set_y(0);
  background.mutable_uniform()->mutable_radiance()->set_z(0);
  sun.set_strength(1);
  sun.set_shadow(0);
  v1::Matte& plaster = *body().mutable_matte();
  plaster.set_roughness(1);
  for (v1::Vec3* colour : {plaster.mutable_colour(), sun.mutable_colour()}) {
    colour->set_x(1);
    colour->set_y(1);
    colour->set_z(1);
  }
  body().mutable_mesh()->mutable_screen_space_normals();
  Eigen::Matrix3f suns;
  suns << 0.5F, 0, 1, -0.3F, 0.5F, 1, -0.3F, -0.5F, 1;
  suns.rowwise().normalize();
  std::array<std::vector<float>, 3> lit;
  for (int i = 0; i < 3; ++i) {
    sun.mutable_direction()->set_x(suns(i, 0));
    sun.mutable_direction()->set_y(suns(i, 1));
    sun.mutable_direction()->set_z(suns(i, 2));
    lit[static_cast<std::size_t>(i)] = draw();
  }

  const Eigen::Matrix3f turn = (Eigen::AngleAxisf(kTurnY * static_cast<float>(kDegrees), Vector3f::UnitY()) *
                                Eigen::AngleAxisf(kTurnX * static_cast<float>(kDegrees), Vector3f::UnitX()))
                                   .toRotationMatrix();
  std::array<int, 8> found{};
  int outside = 0;
  int all = 0;
  for (std::size_t i = 0; i < lit[0].size(); i += 4) {
    const Vector3f radiance(lit[0][i], lit[1][i], lit[2][i]);
    if (radiance.minCoeff() < 0.05F) continue;  // no body, or a face that one of the suns misses
    const Vector3f normal = (suns.inverse() * radiance).normalized();
    float closest = -1;
    std::size_t face = 0;
    for (std::size_t k = 0; k < faces().size(); ++k) {
      const float cosine = normal.dot(turn * faces()[k]);
      if (cosine > closest) face = k;
      closest = std::max(closest, cosine);
    }
    ++all;
    // The rest is the plaster's sheen, up to 2 % of the light.
    if (closest > std::cos(2 * kDegrees)) {
      ++found[face];
    } else {
      ++outside;
    }
  }
  ASSERT_GT(all, 3000);
  // Along edges a pixel is part one face, part another.
  EXPECT_LT(outside, all / 20);
  for (std::size_t k = 0; k < faces().size(); ++k) {
    const float facing = (turn * faces()[k]).z();
    if (facing > 0.4F) {
      EXPECT_GT(found[k], 100) << k;
    } else if (facing < 0) {
      EXPECT_EQ(found[k], 0) << k;
    }
  }
}

TEST_F(MeshNormals, FromThePictureShadeAsFlatOnesThatAreGiven) {
  const std::vector<float> smooth = draw();
  body().mutable_mesh()->mutable_screen_space_normals();
  const std::vector<float> fromPicture = draw();
  body().mutable_mesh()->mutable_given_normals();
  body().mutable_mesh()->set_path(writeOctahedron("flat.obj", true));
  const std::vector<float> flat = draw();
  const auto differing = [&](const std::vector<float>& other) {
    int count = 0;
    for (std::size_t i = 0; i < flat.size(); ++i) {
      if (i % 4 < 3 && std::abs(other[i] - flat[i]) > 0.01F) ++count;
    }
    return count;
  };
  // Screen differences across a silhouette's samples may mix two triangles: a few pixels of 40,000.
  EXPECT_LT(differing(fromPicture), 300);
  EXPECT_GT(differing(smooth), 3000) << "the test can fail";
}

}  // namespace
}  // namespace sluice::testing
