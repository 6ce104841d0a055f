#include "eval/report/html.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "eval/report/joined_garments.h"

namespace dressform {
namespace {

using testing::HasSubstr;
using testing::Not;

cv::Mat grey_picture() { return cv::Mat(20, 30, CV_8UC3, cv::Scalar::all(99)); }

TEST(ReportPage, PicturesSayWhatTheyShowAndHowLargeTheyAre) {
  HtmlPage page("A & B");
  page.figure({"n", "Front", "From <here>", grey_picture()});
  const std::string text = page.text();
  EXPECT_THAT(text, HasSubstr("alt=\"Front. From &lt;here&gt;\" width=\"30\" height=\"20\" loading=\"lazy\""));
  EXPECT_THAT(text, HasSubstr("<h1>A &amp; B</h1>"));
  EXPECT_THAT(text, Not(HasSubstr("<script")));  // nothing to move, nothing to run
}

TEST(ReportPage, MayAskForNothing) {
  HtmlPage page("x");
  page.comparison({"c", "Top", "caption", grey_picture(), grey_picture(), grey_picture()});
  page.model("Garments", "glTF");
  const std::string text = page.text();
  EXPECT_THAT(text, HasSubstr("default-src 'none'"));
  EXPECT_THAT(text, Not(HasSubstr("http:")));
  EXPECT_THAT(text, Not(HasSubstr("https:")));
}

TEST(ReportPage, AComparisonHasAllThreePicturesWithoutScripts) {
  HtmlPage page("x");
  page.comparison({"c", "Top", "caption", grey_picture(), grey_picture(), grey_picture()});
  const std::string text = page.text(),
                    body = text.substr(text.find("<main"), text.find("</main>") - text.find("<main"));
  for (const char* word : {"<span>New</span>", "<span>Reference</span>", "<span>Difference</span>"})
    EXPECT_THAT(body, HasSubstr(word));
  EXPECT_THAT(body, Not(HasSubstr("<script")));
}

TEST(ReportPage, ModelsAreInsideOrSaidToBeAbsent) {
  HtmlPage page("x");
  page.model("Garments", "glTF");
  const std::string text = page.text();
  if (text.find("no 3D view") == std::string::npos)
    EXPECT_THAT(text, HasSubstr(">" + base64("glTF") + "</script>"));
  else
    EXPECT_THAT(text, Not(HasSubstr("data-model=")));
}

TexturedMesh one_triangle(int side, int grey) {
  TexturedMesh mesh;
  mesh.mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.mesh.triangles = {{0, 1, 2}};
  mesh.corner_uv = {{Vector2f(0, 0), Vector2f(1, 0), Vector2f(0, 1)}};
  mesh.texture = cv::Mat(side, side, CV_8UC3, cv::Scalar::all(grey));
  return mesh;
}

TEST(JoinedGarments, KeepTheirOwnColours) {
  const TexturedMesh joined = joined_garments({{"bottom", one_triangle(10, 50)}, {"top", one_triangle(40, 200)}}, 20);
  EXPECT_EQ(joined.texture.size(), cv::Size(30, 20));
  EXPECT_EQ(joined.mesh.triangles[1], Vector3i(3, 4, 5));
  ASSERT_EQ(joined.corner_uv.size(), 2u);
  const auto grey_at = [&](const Vector2f& uv) {
    return joined.texture.at<cv::Vec3b>(static_cast<int>(uv.y() * 20 + 0.5f), static_cast<int>(uv.x() * 30 + 0.5f))[0];
  };
  EXPECT_EQ(grey_at(joined.corner_uv[0][0]), 50);
  EXPECT_EQ(grey_at(joined.corner_uv[1][0]), 200);
  EXPECT_EQ(joined.corner_uv[0][2], Vector2f(0, 0.5f));
  EXPECT_EQ(joined.corner_uv[1][1], Vector2f(1, 0));
  EXPECT_TRUE(joined_garments({}, 20).mesh.triangles.empty());
}

}  // namespace
}  // namespace dressform
