#include "view_splats.h"

#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace sluice::render {

ViewEllipsoid toView(const SplatEllipsoid& ellipsoid, const ViewGeometry& view) {
  const Eigen::Vector3f centre = view.toView(ellipsoid.centre);
  const Eigen::Matrix3f world = ellipsoid.squares();
  const Eigen::Vector3f alongRight = world * view.right;
  const Eigen::Vector3f alongDown = world * view.down;
  const Eigen::Vector3f alongForward = world * view.forward;
  return {centre.x(),
          centre.y(),
          centre.z(),
          ellipsoid.shortest,
          view.right.dot(alongRight),
          view.down.dot(alongDown),
          view.forward.dot(alongForward),
          view.right.dot(alongDown),
          view.right.dot(alongForward),
          view.down.dot(alongForward)};
}

ViewSphere widened(const ViewSphere& sphere, float pixelSlope) {
  return {sphere.x, sphere.y, sphere.z, visibleRadius(sphere.radius, sphere.z, pixelSlope)};
}

ViewEllipsoid widened(const ViewEllipsoid& ellipsoid, float pixelSlope) {
  const float least = visibleRadius(ellipsoid.shortest, ellipsoid.z, pixelSlope);
  const float growth = least * least - ellipsoid.shortest * ellipsoid.shortest;
  ViewEllipsoid result = ellipsoid;
  result.shortest = least;
  result.xx += growth;
  result.yy += growth;
  result.zz += growth;
  return result;
}

SlopeBounds boundsOf(const ViewSphere& sphere) { return sphereBounds({sphere.x, sphere.y, sphere.z}, sphere.radius); }

SlopeBounds boundsOf(const ViewEllipsoid& e) {
  const float scale = 1.0F / (e.z * e.z - e.zz);
  const auto half = [&](float c, float along, float mixed) {
    const float squared = along * (e.z * e.z - e.zz) + e.zz * c * c + mixed * (mixed - 2.0F * c * e.z);
    return std::sqrt(std::max(squared, 0.0F)) * scale;
  };
  return {Eigen::Vector2f(e.x * e.z - e.xz, e.y * e.z - e.yz) * scale, {half(e.x, e.xx, e.xz), half(e.y, e.yy, e.yz)}};
}

float depthExtent(const ViewEllipsoid& ellipsoid) { return std::sqrt(ellipsoid.zz); }

EllipsoidRays::EllipsoidRays(const ViewEllipsoid& e) {
  // In doubles: determinants of small ellipsoids fall below the range of floats.
  Eigen::Matrix3d s;
  s << e.xx, e.xy, e.xz, e.xy, e.yy, e.yz, e.xz, e.yz, e.zz;
  const Eigen::Vector3d c(e.x, e.y, e.z);
  const double determinant = s.determinant();
  const Eigen::Matrix3d q = s.inverse();
  const Eigen::Vector3d m = q * c;
  const Eigen::Matrix3d l = Eigen::LLT<Eigen::Matrix3d>(s).matrixL().toDenseMatrix() / std::sqrt(determinant);
  qxx = static_cast<float>(q(0, 0));
  qyy = static_cast<float>(q(1, 1));
  qzz = static_cast<float>(q(2, 2));
  qxy = static_cast<float>(q(0, 1));
  qxz = static_cast<float>(q(0, 2));
  qyz = static_cast<float>(q(1, 2));
  mx = static_cast<float>(m.x());
  my = static_cast<float>(m.y());
  mz = static_cast<float>(m.z());
  l11 = static_cast<float>(l(0, 0));
  l21 = static_cast<float>(l(1, 0));
  l31 = static_cast<float>(l(2, 0));
  l22 = static_cast<float>(l(1, 1));
  l32 = static_cast<float>(l(2, 1));
  l33 = static_cast<float>(l(2, 2));
  room = static_cast<float>(c.dot(m) - 1.0);
  volume = static_cast<float>(4.0 / 3.0 * std::numbers::pi * std::sqrt(determinant));
}

}  // namespace sluice::render
