#pragma once
#include "eval/oracle/oracle.h"
#include "pipeline/garment/garment_layout.h"

namespace dressform {

// A garment of the truth in the run's model frame.
Mesh garment_in_model(const OracleInput& input, const std::string& slot);

// What garments there are and where they go, told from the true cloth on the run's body with its landmarks: kinds by
// the names of the true rims. With `order`, how the two lie to one another as well.
GarmentLayouts true_layouts(const OracleInput& input, bool order);

}  // namespace dressform
