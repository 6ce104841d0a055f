#pragma once
#include <vector>

#include "pipeline/open/cut.h"
#include "pipeline/open/open.h"
#include "pipeline/open/openings.h"
#include "pipeline/open/rim_fit.h"

namespace dressform {

// The loops of an open mesh, each named after the opening whose cut is nearest. `observed`: of each opening.
// `curves`, where there are: of each opening, they know which stretches no view saw.
std::vector<Rim> named_rims(const Mesh& mesh, const CutResult& cut, const std::vector<Opening>& openings,
                            const std::vector<bool>& observed, const std::vector<RimCurve>& curves = {});

}  // namespace dressform
