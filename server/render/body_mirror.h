#pragma once

#include <Eigen/Geometry>

#include "body_scene.h"
#include "frame_uniforms.h"
#include "sluice/core/particle_snapshot.h"
#include "sluice/gl/objects.h"

namespace sluice::render {

/// What a liquid has to know of the bodies that it mirrors.
struct BodyMirror {
  float reach = 0;                                   ///< How far bodies reach behind what is seen of them, m.
  int steps = 0;                                     ///< Places along a ray that are looked at.
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();  ///< From where the cube map sees them, m.

  /// Without bodies, or where the liquid mirrors none, there are no steps.
  static BodyMirror of(const core::ParticleSnapshot& particles, const v1::Liquid& liquid, const v1::Scene& scene,
                       const BodyScene& bodies, const Eigen::Vector3f& eye);
};

/// The middle of a liquid: its centre of mass to within a particle spacing, so that a liquid at rest has the same from
/// frame to frame. Where that is inside a body, a place before the body as the eye sees it.
Eigen::Vector3f middleOf(const core::ParticleSnapshot& particles, const BodyScene& bodies, const Eigen::Vector3f& eye);

/// The six faces around a point, in GL's order and orientation: what a picture of them has as its rows and columns.
ViewGeometry cubeFace(const Eigen::Vector3f& middle, int face, int edge);

/// Light and 1/distance of bodies in all directions around a liquid's middle, kept from frame to frame. Lives on the
/// thread of the context.
class BodyCube {
 public:
  /// What it shows.
  struct Content {
    Eigen::Vector3f middle = Eigen::Vector3f::Zero();
    int edge = 0;
    std::uint64_t bodyChanges = 0;  ///< See BodyScene; counts the lights as well.
    v1::Background background;
  };

  /// Whether it would be drawn the same.
  bool shows(const Content& content) const;
  /// Makes room for six pictures of content.edge². Draw them next.
  void begin(const Content& content);
  /// To draw a face into, with depth.
  GLuint framebufferOf(int face);

  void bind() const;

 private:
  Content content_;
  gl::Texture light_;     ///< And 1 where there is a body.
  gl::Texture distance_;  ///< 1/distance, and the same 1.
  gl::Texture depth_;
  gl::Framebuffer framebuffer_;
};

}  // namespace sluice::render
