#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgproc.hpp>

#include "eval/figures/grid_file.h"
#include "scenes/error.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class GridToml : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / "grid";
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "run");
    std::ofstream(folder_ / "run/run.json") << "{}";
  }
  GridFile read(const std::string& text) const {
    std::ofstream(folder_ / "grid.toml") << text;
    return read_grid(folder_ / "grid.toml");
  }
  std::string error_of(const std::string& text) const {
    try {
      read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  fs::path folder_;
};

TEST_F(GridToml, ACellTakesOfTheColumnWhatTheRowLeavesOpen) {
  const GridFile grid = read(
      "width = \"column\"\n[[row]]\nlabel = \"ours\"\nrun = \"run\"\nview_deg = 90\n"
      "[[column]]\nlabel = \"result\"\nshow = \"mannequin\"\nview_deg = 10\n"
      "[[column]]\nimage = \"renders/a.png\"\n[[zoom]]\nx = 0.5\ny = 0.25\nwidth = 0.5\nheight = 0.1\n");
  EXPECT_TRUE(grid.column);
  ASSERT_EQ(grid.columns.size(), 2u);
  const GridChoice cell = joined_choice(grid.rows[0], grid.columns[0]);
  EXPECT_EQ(cell.show, "mannequin");
  EXPECT_EQ(cell.view_deg, 90);
  EXPECT_EQ(cell.run.filename(), "run");
  EXPECT_EQ(joined_choice(grid.rows[0], grid.columns[1]).show, "image");
  EXPECT_EQ(grid.zooms.size(), 1u);
}

TEST_F(GridToml, ErrorsNameFilePlaceAndWhatIsExpected) {
  const std::string row = "[[row]]\nrun = \"run\"\n";
  EXPECT_THAT(error_of(row + "[[column]]\nlabel = \"x\"\n"), HasSubstr("row 1, column 1: found no show"));
  EXPECT_THAT(error_of("[[row]]\n[[column]]\nshow = \"user\"\n"), HasSubstr("found no run"));
  EXPECT_THAT(error_of(row), HasSubstr("no [[column]]"));
  EXPECT_THAT(error_of(row + "colour = 3\n[[column]]\nshow = \"user\"\n"), HasSubstr("colour"));
  EXPECT_THAT(error_of(row + "[[column]]\nshow = \"back\"\n"), HasSubstr("capture"));
  EXPECT_THAT(error_of("[[row]]\nrun = \"nowhere\"\n[[column]]\nshow = \"user\"\n"), HasSubstr("nowhere"));
  EXPECT_THAT(error_of(row + "[[column]]\nshow = \"user\"\n[[zoom]]\nx = 0.9\nwidth = 0.2\nheight = 0.2\n"),
              HasSubstr("leaves the picture"));
}

GridFigure two_by_two() {
  const cv::Mat green(100, 50, CV_8UC3, cv::Scalar(0, 255, 0)), blue(100, 50, CV_8UC3, cv::Scalar(255, 0, 0));
  return {"g",
          "A caption.",
          {"first", "second"},
          {"above", "below"},
          {{{green, "0.91"}, {blue, "0.88"}}, {{blue, ""}, {cv::Mat(), "not made"}}},
          {},
          {}};
}

TEST(GridSheet, HasLabelsNotesAndCellsInTheirPlaces) {
  const Sheet sheet = grid_sheet(two_by_two());
  const std::string svg = sheet_svg(sheet);
  for (const char* text : {">first<", ">second<", ">above<", ">below<", ">0.91<", ">not made<", ">A caption.<"})
    EXPECT_THAT(svg, HasSubstr(text));
  const cv::Mat image = sheet_image(sheet, 60);
  cv::Mat green;
  cv::inRange(image, cv::Scalar(0, 255, 0), cv::Scalar(0, 255, 0), green);
  const cv::Rect box = cv::boundingRect(green);
  EXPECT_LT(box.x + box.width, image.cols / 2);
  EXPECT_LT(box.y + box.height, image.rows * 6 / 10);
}

TEST(GridSheet, ZoomsAreFramedInThePictureAndShownBelowIt) {
  GridFigure figure = two_by_two();
  const double before = grid_sheet(figure).height_mm;
  figure.zooms.push_back({0.5, 0.5, 0.25, 0.25});
  EXPECT_GT(grid_sheet(figure).height_mm, before + 10);
  figure.zooms.push_back({0.9, 0.5, 0.25, 0.25});
  EXPECT_THROW(grid_sheet(figure), std::invalid_argument);
  figure.zooms.clear();
  figure.cells[0].pop_back();
  EXPECT_THROW(grid_sheet(figure), std::invalid_argument);
}

}  // namespace
}  // namespace dressform
