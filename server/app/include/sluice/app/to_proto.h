#pragma once

#include <optional>

#include "sluice/core/flow_measures.h"
#include "sluice/core/interaction.h"
#include "sluice/core/particle_snapshot.h"
#include "sluice/core/plan.h"
#include "sluice/core/stage_times.h"
#include "sluice/render/pick_fluid.h"
#include "sluice/v1/session.pb.h"

namespace sluice::app {

/// Everything of Stats that a source knows by itself.
v1::Stats toProto(const core::StepStatistics& statistics, const core::FlowMeasures& measures);

v1::Plan toProto(const core::Plan& plan);

/// `none` for a ray that meets no fluid.
v1::Picked toProto(const std::optional<render::PickedFluid>& picked, const core::ParticleSnapshot& particles);

/// Of a checked message; figures that it leaves out take their defaults.
core::Interaction fromProto(const v1::Interact& interact);

}  // namespace sluice::app
