#pragma once

#include <string>
#include <vector>

#include "sluice/gl/context.h"

namespace sluice::evaluate {

/// What figures were measured on, in a line: "llvmpipe (…), AMD EPYC, 2 threads".
std::string machineName(const gl::Context& context);

/// Without what draws: "AMD EPYC, 2 threads".
std::string processorName();

/// The middle value (the mean of the middle two); 0 for none.
double median(std::vector<double> values);

}  // namespace sluice::evaluate
