#include "synthetic/capture/ray_table.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace dressform {

RayTable::RayTable(const Camera& camera)
    : width_(camera.width), height_(camera.height), table_((camera.width + 2) * (camera.height + 2)) {
  tbb::parallel_for(0, height_ + 2, [&](int row) {
    for (int column = 0; column < width_ + 2; ++column)
      table_[row * (width_ + 2) + column] = camera.normalized(Vector2d(column - 1, row - 1)).cast<float>();
  });
}

Vector2f RayTable::at(float x, float y) const {
  const int x0 = std::clamp(static_cast<int>(std::floor(x)), -1, width_ - 1);
  const int y0 = std::clamp(static_cast<int>(std::floor(y)), -1, height_ - 1);
  const float ax = x - x0, ay = y - y0;
  return (1 - ay) * ((1 - ax) * at(x0, y0) + ax * at(x0 + 1, y0)) +
         ay * ((1 - ax) * at(x0, y0 + 1) + ax * at(x0 + 1, y0 + 1));
}

}  // namespace dressform
