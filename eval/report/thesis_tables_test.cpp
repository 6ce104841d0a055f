#include "eval/report/thesis_tables.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "eval/report/thesis_figures.h"

namespace dressform {
namespace {

namespace known = thesis_figures;

// A run that came out as the thesis's group 1 did, but for its left view, which was not registered.
RunCounts as_group1() {
  RunCounts run;
  run.run = "mine";
  run.scene = "group1";
  run.sensors = {"k1", "k2", "k3", "k4"};
  run.view = {{"k1", "Front"}, {"k2", "Right"}, {"k3", "Back"}};
  run.not_registered["k4"] = "no mannequin was seen, in its naked shot";
  for (const auto& [sensor, view] : {std::pair("k1", 0), std::pair("k2", 3), std::pair("k3", 1)}) {
    run.mannequin[sensor] = known::kMannequinPixels[0][view];
    run.image[sensor] = known::kImagePixels;
    run.model_from_sensor[sensor] = Isometry3d::Identity();
    for (const auto& [slot, garment] : {std::pair("top", known::kShirts[0]), std::pair("bottom", known::kBottoms[0])})
      run.garments[slot].pixels[sensor] = {garment.pixels[view], garment.filled_pixels[view] - garment.pixels[view]};
  }
  for (const auto& sensor : run.sensors) {
    SensorCalibration camera;
    camera.color = Camera{1920, 1080, 1000, 1000, 959.5, 539.5};
    camera.ir = Camera{512, 424, 365, 365, 255.5, 211.5};
    run.calibration.sensors[sensor] = camera;
  }
  run.garments["top"].points = 23871;
  run.garments["top"].cleaned = 23555;
  run.garments["top"].closed = MeshCounts{21163, 42322, 0};
  run.garments["top"].open = MeshCounts{19089, 37935, 247};
  run.garments["bottom"].not_closed = "surface made none of it";
  run.garments["bottom"].not_open = "there was no closed surface to open";
  return run;
}

const ThesisTable& table_of(const std::vector<ThesisTable>& tables, int number) {
  return *std::find_if(tables.begin(), tables.end(), [&](const auto& t) { return t.number == number; });
}

TEST(ThesisTables, AreThoseOfTheThesis) {
  std::vector<int> numbers;
  for (const auto& table : thesis_tables({as_group1()})) numbers.push_back(table.number);
  EXPECT_EQ(numbers, (std::vector<int>{4, 5, 6, 7, 9, 10, 11, 12, 13, 14, 15}));
}

TEST(ThesisTables, ARunThatIsTheThesisHasItsFigures) {
  const auto tables = thesis_tables({as_group1()});
  for (const int number : {9, 10, 12, 14})
    for (const auto& row : table_of(tables, number).rows)
      for (const auto& figure : row.figures)
        if (figure.value != "-") {
          EXPECT_EQ(figure.value, figure.thesis) << number << " " << figure.measure;
        }
  EXPECT_EQ(table_of(tables, 14).rows[0].figures.back().thesis, "247");  // as many as the picked points
  EXPECT_EQ(table_of(tables, 15).rows[0].figures.back().thesis, "162");
  EXPECT_EQ(table_of(tables, 9).rows[0].names[1], "Front (k1)");
  EXPECT_EQ(table_of(tables, 4).rows[1].figures[0].thesis, "1060.822");
  EXPECT_EQ(table_of(tables, 6).rows[2].figures[9].thesis, "51.5690");
}

TEST(ThesisTables, WhatIsMissingHasAReason) {
  const auto tables = thesis_tables({as_group1()});
  for (const auto& table : tables)
    for (const auto& row : table.rows)
      for (const auto& figure : row.figures)
        EXPECT_EQ(figure.value == "-", !figure.reason.empty()) << table.number << " " << figure.measure;
  const auto& pose = table_of(tables, 7).rows[3].figures[0];
  EXPECT_EQ(pose.value, "-");
  EXPECT_EQ(pose.reason, "not registered: no mannequin was seen, in its naked shot");
  EXPECT_EQ(table_of(tables, 15).rows[0].figures[2].reason, "there was no closed surface to open");
  RunCounts other = as_group1();
  other.scene = "mine";
  other.scale = 0.5;
  const auto alone = thesis_tables({other});
  EXPECT_EQ(table_of(alone, 9).rows[0].figures[0].thesis, "-");
  EXPECT_EQ(table_of(alone, 4).rows[0].figures[0].value, "2000.000");  // of the full image
  EXPECT_EQ(table_of(alone, 9).notes.size(), 4u);                      // both figures of k4, the scale, the scene
}

TEST(ThesisTables, AreWrittenForPeopleAndPrograms) {
  const auto tables = thesis_tables({as_group1()});
  const std::string csv = tables_csv(tables), markdown = tables_markdown(tables), latex = tables_latex(tables);
  EXPECT_NE(csv.find("14,mine,Shirt 1,V before,21163,21163,\n"), std::string::npos);
  EXPECT_NE(csv.find("\"not registered: no mannequin was seen, in its naked shot\"\n"), std::string::npos);
  EXPECT_NE(markdown.find("| mine | Shirt 1 | 21163 | 21163 | 42322 | 42322 |"), std::string::npos);
  EXPECT_NE(latex.find("mine & Shirt 1 & 21163 & 21163 & 42322"), std::string::npos);
  EXPECT_NE(latex.find("\\toprule"), std::string::npos);
  EXPECT_NE(latex.find("{V before}"), std::string::npos);  // a head in a column of numbers
  EXPECT_NE(latex.find("{llSS"), std::string::npos);
  EXPECT_NE(tables_html(tables).find("<td>21163</td>"), std::string::npos);
  EXPECT_NE(latex.find("k4 (Kinect 4)"), std::string::npos);
  EXPECT_EQ(std::count(latex.begin(), latex.end(), '{'), std::count(latex.begin(), latex.end(), '}'));
}

TEST(RunCounts, AViewIsTheSideThatItSees) {
  Landmarks body;  // faces +z, its left is +x
  body.axis = Vector3d(0.1, 1, 0);
  EXPECT_EQ(view_of(body, {0.2, 1.2, 2}), "Front");
  EXPECT_EQ(view_of(body, {0, 1.2, -2}), "Back");
  EXPECT_EQ(view_of(body, {2, 1.2, 0.5}), "Left");
  EXPECT_EQ(view_of(body, {-2, 1.2, -0.5}), "Right");
}

}  // namespace
}  // namespace dressform
