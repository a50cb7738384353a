#pragma once

#include <string>

#include "sluice/solids/body_shape.h"

namespace sluice::solids {

/// Of the solid that a closed surface encloses, in the body's own axes.
struct MassProperties {
  double volume = 0;                                  ///< m³.
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   ///< Of mass, m.
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< About the centre, for a density of 1 kg/m³, kg m².
};

/// Exact: in closed form, or by integrals over the polyhedron that a mesh is. Throws core::InputError under `fieldPath`
/// where the surface has no inside, or the triangles do not all face the same way.
MassProperties massPropertiesOf(const v1::Body& body, const BodyShape& shape, const std::string& fieldPath);

}  // namespace sluice::solids
