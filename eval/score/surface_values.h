#pragma once
#include <optional>
#include <string>
#include <vector>

#include "eval/metrics/surface_metrics.h"
#include "eval/score/metric_family.h"

namespace dressform {

// A number of a comparison of two surfaces, under the name of its metric without the family: "accuracy_mm".
struct SurfaceValue {
  const char* name;
  double (*value)(const metrics::SurfaceComparison&);
};

// Distances and normals, asked of bodies and of garments. `family` is "<body>" or "<slot>".
const std::vector<SurfaceValue>& distance_values();
std::vector<Metric> distance_metrics(const std::string& family);

// The estimate, brought to the world, against the truth; absent where one of them has no area or nothing joins them.
std::optional<metrics::SurfaceComparison> compared_in_world(const Mesh& mesh,
                                                            const std::optional<Isometry3d>& world_from_model,
                                                            const Mesh& truth, const std::vector<std::uint8_t>& views,
                                                            double spacing_m, Seed seed);

// One row a value; without a comparison rows of that status.
void add_values(StageRows& rows, const std::string& family, const std::string& member,
                const std::vector<SurfaceValue>& values, const std::optional<metrics::SurfaceComparison>& comparison,
                const std::string& status_without);

}  // namespace dressform
