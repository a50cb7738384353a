#pragma once

#include <span>
#include <vector>

#include "sluice/core/particle_snapshot.h"
#include "sluice/v1/scene.pb.h"
#include "view_geometry.h"

namespace sluice::render {

/// A secondary particle as the camera sees it: a soft dot, round in the picture, that fades below the liquid's surface.
struct FoamDot {
  float x, y, z;  ///< Middle in view space, m; z > 0.
  float radius;   ///< m.
  float opacity;  ///< Optical depth through its middle: it hides 1 - exp(-opacity) there.
  float fading;   ///< By how much it fades with its depth below the surface, 1/m.
};

/// The dots whose middle is in the picture, in the order of the particles. `scene` is complete and has foam.
std::vector<FoamDot> makeFoamDots(const core::DiffuseParticles& particles, const v1::Scene& scene, double spacing,
                                  const ViewGeometry& view);

/// How far below the drawn surface a dot still lies on it, m: splats reach beyond the particles that carry the foam.
float foamBed(const v1::Scene& scene, double spacing);

/// A liquid's surface as the foam is compared with it.
struct FoamCover {
  std::span<const float> inverseDepth;
  ViewGeometry view;
};

/// What a picture of dots is compared with.
struct FoamCovers {
  std::span<const FoamCover> liquids;
  float bed = 0;                           ///< See foamBed.
  std::span<const float> sceneDepth = {};  ///< Inverse eye depth of floor and bodies in the dots' own view, or empty.
};

/// Adds up the dots' optical depth along every line of sight on the CPU: what foam.vert and foam.frag draw. Each row is
/// summed in the order of the dots, so that the result is the same for any number of threads.
void drawFoam(std::span<const FoamDot> dots, const ViewGeometry& view, const FoamCovers& covers,
              std::span<float> opticalDepth);

}  // namespace sluice::render
