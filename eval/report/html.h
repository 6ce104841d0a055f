#pragma once
#include <string>
#include <vector>

#include "eval/report/image_tools.h"
#include "render/charts/markup.h"

namespace dressform {

// One self-contained HTML page: styles and images inside, nothing fetched. Parts appear in the order they are added.
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
  // An SVG drawing, taken over as it is.
  void drawing(const std::string& title, const std::string& caption, const std::string& svg);
  void preformatted(const std::string& summary, const std::string& text);  // folded away

  std::string text() const;

 private:
  std::string title_, contents_, body_;
};

}  // namespace dressform
