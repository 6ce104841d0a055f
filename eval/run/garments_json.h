#pragma once
#include <string>

#include "pipeline/garment/garment_layout.h"
#include "pipeline/open/open.h"

namespace dressform {

// What garments the pipeline found, as JSON text: per slot ("top", "bottom") kind, how it is worn, and where it goes on
// the limbs, metres along each from its root, on the mannequin; and why a garment could not be opened.
std::string garments_json(const OpenGarments& opened);

// The same of one garment in a sentence for the report.
std::string word_of(const std::string& slot, const GarmentLayout& layout);

}  // namespace dressform
