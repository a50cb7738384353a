#pragma once

#include "view_splats.h"

namespace sluice::render {

/// Pixels drawn at once; rows are padded by as many.
inline constexpr int kSplatBlock = 16;

// One splat along one row of a picture, from the pixel at whose middle the line of sight is (slopes[0], slopeY). Rows
// are drawn in whole blocks: up to kSplatBlock − 1 pixels beyond `count` are drawn as well, where the splat, if it is
// there at all, belongs.
//
// Depth rows keep the larger of what is there and the inverse depth of the splat's front. Chord rows add
// weight·√(1+|W|²) times the length of the line of sight inside, halved: see finishChords.

/// A flat rim, than which a sphere's front is nowhere farther: the plane that faces the eye, `rimDepth` radii before
/// the centre, has the inverse depth rim·(c·(W, 1)), which a row draws. 0 for none.
float rimOf(const ViewSphere& sphere, float rimDepth);
/// The same for an ellipsoid: rim·(c·Q(W, 1)). In the space where it is the unit sphere the plane faces the eye, so
/// that the rim lies along a flat ellipsoid, whichever way that is turned.
float rimOf(const EllipsoidRays& rays, float rimDepth);

/// With the line of sight W and the sphere's centre c, e = c_xy − c_z·W and k = c_x·W_y − c_y·W_x, the discriminant is
///   D = R²(1+|W|²) − |e|² − k²
/// and the front's inverse depth q = (c·(W, 1) + √D) / (|c|² − R²): every term is a difference of small numbers, and a
/// line of sight costs one root and no division.
void drawDepthRow(const ViewSphere& sphere, float rim, float slopeY, const float* slopes, float* q, int count);
void drawChordRow(const ViewSphere& sphere, float weight, float slopeY, const float* slopes, float* sum, int count);

/// The farthest sides of splats as inverse depth: the smaller of what is there and (c·(W, 1) − √D) / (|c|² − R²). `rim`
/// is that of backRimOf, than which no splat's back is nearer.
void drawBackRow(const ViewSphere& sphere, float rim, float slopeY, const float* slopes, float* q, int count);
void drawBackRow(const EllipsoidRays& rays, const ViewEllipsoid& ellipsoid, float rim, float slopeY,
                 const float* slopes, float* q, int count);
void drawDiscBackRow(const ViewSphere& sphere, float slopeY, const float* slopes, float* q, int count);

/// The flat rim of a splat's back, see rimOf: the plane `rimDepth` radii *behind* the centre. For a depth of 0 a plane
/// before everything, which cuts nothing off.
float backRimOf(const ViewSphere& sphere, float rimDepth);
float backRimOf(const EllipsoidRays& rays, float rimDepth);

/// See EllipsoidRays.
void drawDepthRow(const EllipsoidRays& rays, const ViewEllipsoid& ellipsoid, float rim, float slopeY,
                  const float* slopes, float* q, int count);
void drawChordRow(const EllipsoidRays& rays, const ViewEllipsoid& ellipsoid, float weight, float slopeY,
                  const float* slopes, float* sum, int count);

/// A disc about the sphere's centre, parallel to the picture.
void drawDiscRow(const ViewSphere& sphere, float slopeY, const float* slopes, float* q, int count);

/// Adds to each pixel its sum of chords, 2·sum/√(1+|W|²).
void finishChords(const float* sum, const float* slopes, float slopeY, float* thickness, int count);

}  // namespace sluice::render
