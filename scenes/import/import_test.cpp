#include "scenes/import/import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/import/stamped_files.h"
#include "scenes/testing/variant_files.h"

namespace dressform {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;

TEST(Associate, NearestFirstAndEachOnce) {
  const std::vector<StampedFile> a{{0.00, ""}, {0.10, ""}, {0.12, ""}, {0.50, ""}},
      b{{0.01, ""}, {0.115, ""}, {0.9, ""}};
  EXPECT_THAT(associate(a, b, 0.02), ElementsAre(std::pair(0, 0), std::pair(2, 1)));
  EXPECT_THAT(associate(a, b, 0.4), ElementsAre(std::pair(0, 0), std::pair(2, 1), std::pair(3, 2)));
  EXPECT_THAT(associate(a, {}, 1), ElementsAre());
}

TEST(Importers, OneForEachFormat) {
  EXPECT_THAT(Importer::names(), ElementsAreArray(variant_files(DRESSFORM_SOURCE_DIR "/scenes/import")));
}

}  // namespace
}  // namespace dressform
