#pragma once

#include <google/protobuf/repeated_ptr_field.h>

#include "sluice/core/particle_snapshot.h"
#include "sluice/core/plan.h"
#include "sluice/core/stage_times.h"
#include "sluice/v1/session.pb.h"

namespace sluice::app {

/// Everything of Stats that a step knows by itself.
v1::Stats toProto(const core::StepStatistics& statistics);

v1::Plan toProto(const core::Plan& plan);

}  // namespace sluice::app
