#pragma once
#include <string>
#include <vector>

#include "eval/report/image_tools.h"
#include "render/charts/markup.h"

namespace dressform {

// Pictures of one thing, all of one size: what was made now, what it should be, and how far they are apart.
struct ImageComparison {
  std::string name;  // file stem of its three images
  std::string title, caption;
  cv::Mat made, reference, difference;  // 8-bit BGR
};

// One self-contained HTML page: styles, images and scripts inside, nothing fetched. Parts appear in the order they are
// added. All of it can be read with scripts blocked: they only flip comparisons and turn models.
class HtmlPage {
 public:
  explicit HtmlPage(std::string title) : title_(std::move(title)) {}

  struct Cell {
    std::string text;
    std::string mark;  // "", "good", "bad", "quiet"
  };
  void heading(const std::string& text, const std::string& id);  // appears in the contents
  void subheading(const std::string& text);
  void paragraph(const std::string& text);
  void verdict(const std::string& text, bool good);
  void table(const std::vector<std::string>& columns, const std::vector<std::vector<Cell>>& rows);
  void figure(const Figure& figure);
  void comparison(const ImageComparison& comparison);
  // A GLB file's bytes, to be turned; a word instead where the program was built without the viewer.
  void model(const std::string& title, const std::string& glb);
  // An SVG drawing, taken over as it is.
  void drawing(const std::string& title, const std::string& caption, const std::string& svg);
  void preformatted(const std::string& summary, const std::string& text);  // folded away

  std::string text() const;

 private:
  std::string title_, contents_, body_;
  bool scripts_ = false;
  int models_ = 0;
};

}  // namespace dressform
