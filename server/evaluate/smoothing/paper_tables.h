#pragma once

#include <string>
#include <vector>

#include "sluice/evaluate/report.h"
#include "sluice/evaluate/study.h"
#include "sluice/render/fluid_renderer.h"

namespace sluice::evaluate {

/// Tables 1 and 2 of van der Laan, Green & Sainz 2009 measured again: column_and_sheet with 64,000 particles at
/// 1024×768, whole frames, the paper's figures beside ours and the default look below. Settings that the schema does
/// not offer are left out, with a note.
std::vector<Row> paperTableRows(render::FluidRenderer& renderer, const Options& options, const std::string& machine,
                                std::vector<std::string>& notes);

}  // namespace sluice::evaluate
