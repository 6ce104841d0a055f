#pragma once
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "eval/wardrobe/dressing.h"

namespace dressform {

// One place of the picture: a body in its clothes; without a body, an empty place.
struct PicturedBody {
  const KnownBody* body = nullptr;
  const Dressed* clothes = nullptr;
  std::string caption;  // a few words under the place
};

// Rows of dressed bodies from the front, all at one scale, standing on one line; 8-bit BGR. `tile_height`: pixels of
// one place without its caption. Empty for no rows.
cv::Mat wardrobe_picture(const std::vector<std::vector<PicturedBody>>& rows, int tile_height);

}  // namespace dressform
