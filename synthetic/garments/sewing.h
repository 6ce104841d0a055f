#pragma once
#include <vector>

#include "synthetic/garments/garment.h"

namespace dressform {

// Cuts the garment's closed shape open, divides the cloth evenly, lets it fall on the body and what is worn beneath,
// and prints it. Throws InputError where the cloth finds no room on the body.
Garment sewn_garment(const GarmentSpec& spec, const Body& body, const std::vector<Garment>& inner, Seed seed);

}  // namespace dressform
