#include "driven_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sluice/scene/convert.h"

namespace sluice::sim {

namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;

Quaterniond turnedBy(const Vector3d& axisTimesAngle) {
  const double angle = axisTimesAngle.norm();
  return angle > 0 ? Quaterniond(AngleAxisd(angle, axisTimesAngle / angle)) : Quaterniond::Identity();
}

/// Shortest rotation vector of a rotation.
Vector3d rotationVector(const Quaterniond& q) {
  const AngleAxisd turn(q.w() < 0 ? Quaterniond(-q.coeffs()) : q);
  return turn.angle() * turn.axis();
}

/// How a driven motion grows: smoothly from 0 to 1 within the ramp.
double grown(double since, double ramp) {
  if (since <= 0) return 0;
  const double s = ramp > 0 ? std::min(since / ramp, 1.0) : 1;
  return s * s * (3 - 2 * s);
}

/// Its integral over time, s.
double grownTime(double since, double ramp) {
  if (since <= 0) return 0;
  if (since >= ramp) return since - 0.5 * ramp;
  const double s = since / ramp;
  return ramp * (s * s * s - 0.5 * s * s * s * s);
}

bool isZero(const v1::Vec3& v) { return v.x() == 0 && v.y() == 0 && v.z() == 0; }

}  // namespace

bool moves(const v1::Body& body) {
  const v1::Driven& d = body.driven();
  return body.has_driven() && !(isZero(d.velocity()) && isZero(d.spin()) && isZero(d.sway()) && isZero(d.rock()));
}

Isometry3d drivenPose(const v1::Driven& driven, const Isometry3d& start, double time) {
  const double since = time - driven.start_seconds();
  const double steady = grownTime(since, driven.ramp_seconds());
  const double swing = grown(since, driven.ramp_seconds()) *
                       std::sin(2 * std::numbers::pi * std::max(since, 0.0) / driven.period_seconds());
  Isometry3d pose = Isometry3d::Identity();
  pose.translate(start.translation() + steady * scene::toVector(driven.velocity()) +
                 swing * scene::toVector(driven.sway()));
  pose.rotate(turnedBy(swing * kDegree * scene::toVector(driven.rock())) *
              turnedBy(steady * kDegree * scene::toVector(driven.spin())) * Quaterniond(start.rotation()));
  return pose;
}

Eigen::Matrix<double, 6, 1> twistBetween(const Isometry3d& from, const Isometry3d& to, double seconds) {
  Eigen::Matrix<double, 6, 1> twist;
  twist << (to.translation() - from.translation()) / seconds,
      rotationVector(Quaterniond(to.rotation() * from.rotation().transpose())) / seconds;
  return twist;
}

double drivenSpeed(const v1::Driven& driven, double radius, double time) {
  if (time < driven.start_seconds()) return 0;
  // The steepest slope of the ramp is 3/2 of its mean.
  const double swing =
      2 * std::numbers::pi / driven.period_seconds() + (driven.ramp_seconds() > 0 ? 1.5 / driven.ramp_seconds() : 0);
  const auto speed = [&](const v1::Vec3& steady, const v1::Vec3& swung) {
    return scene::toVector(steady).norm() + swing * scene::toVector(swung).norm();
  };
  return speed(driven.velocity(), driven.sway()) + kDegree * speed(driven.spin(), driven.rock()) * radius;
}

}  // namespace sluice::sim
