#include "synthetic/garments/garment.h"

#include <utility>

#include "scenes/mesh_frame.h"
#include "scenes/mesh_io.h"
#include "synthetic/garments/own_garment.h"
#include "synthetic/garments/sewing.h"

namespace dressform {
namespace {

Garment garment_from_files(const GarmentSpec& spec, const Body& body) {
  TexturedMesh read = read_textured_mesh(spec.mesh, spec.texture);
  read.mesh = in_world(std::move(read.mesh), spec.frame);
  check_lies_on(read.mesh, spec, body);
  MendedMesh mesh = mended(std::move(read), spec.mesh.string());
  Garment garment;
  garment.rims = rims_of_garment(mesh, spec);
  garment.textured = std::move(mesh.textured);
  return garment;
}

}  // namespace

Garment make_garment(const GarmentSpec& spec, const Body& body, const std::vector<Garment>& inner, Seed seed) {
  return spec.mesh.empty() ? sewn_garment(spec, body, inner, seed) : garment_from_files(spec, body);
}

}  // namespace dressform
