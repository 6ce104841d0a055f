// How one mesh compares with another: mesh_score ESTIMATE TRUTH, in metres, OBJ, PLY or GLB.
#include <cstdio>

#include "eval/metrics/surface_metrics.h"
#include "scenes/error.h"
#include "scenes/mesh_io.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: mesh_score ESTIMATE TRUTH\n");
    return 2;
  }
  try {
    const auto compared =
        dressform::metrics::compare_surfaces(dressform::read_mesh(argv[1]), dressform::read_mesh(argv[2]));
    std::printf("accuracy %.3f mm, completeness %.3f mm, F at 5 mm %.3f\n", compared.accuracy_mm,
                compared.completeness_mm, compared.f.at(5));
  } catch (const dressform::InputError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 2;
  }
}
