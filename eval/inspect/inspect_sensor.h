#pragma once
#include <functional>

#include "eval/inspect/inspection.h"
#include "scenes/fields.h"

namespace dressform {

// Called before each part: what it is, its number and how many there are.
using InspectionProgress = std::function<void(const std::string& what, int done, int total)>;

// What a registered sensor model makes of planes, edges and floors of known depth, beside the published figures and
// their tolerances. `values` are parameters of the model beside those that a measurement sets itself (bias off for
// noise, noise off for decoding). Throws InputError for an unknown model or parameter.
Inspection inspect_sensor(const std::string& model, const FieldValues& values, const InspectionProgress& progress);

}  // namespace dressform
