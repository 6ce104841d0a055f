#pragma once
#include <vector>

#include "synthetic/garments/garment.h"
#include "synthetic/geometry/mending.h"

namespace dressform {

// What is asked of someone's own garment mesh before it is worn.

// Throws InputError naming the mesh's file, with what was found, where the garment does not lie on the body as clothes
// do, and which unit or axis would make it do so. `mesh`: metres, world frame.
void check_lies_on(const Mesh& mesh, const GarmentSpec& spec, const Body& body);

// The rims of the largest piece that a limb fits through, named by where they are. Of those that go round the middle
// the highest is the neck or the waist and the lowest the hem; those at the sides are cuffs or ankles. Throws
// InputError with number and place of the openings where the kind's are not among them.
std::vector<TruthRim> rims_of_garment(const MendedMesh& mesh, const GarmentSpec& spec);

}  // namespace dressform
