#include "eval/report/html.h"

#include <fmt/format.h>

#include <opencv2/imgcodecs.hpp>

#include "eval/report/html_assets.h"
#include "eval/report/viewer_code.h"

namespace dressform {
namespace {

// A picture as a JPEG inside the page, decoded when it comes into sight; its size is known before.
std::string image_tag(const cv::Mat& image, const std::string& alt) {
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, 90});
  return fmt::format(
      "<img alt=\"{}\" width=\"{}\" height=\"{}\" loading=\"lazy\" decoding=\"async\" "
      "src=\"data:image/jpeg;base64,{}\">",
      html_escaped(alt), image.cols, image.rows, base64(std::string(bytes.begin(), bytes.end())));
}

std::string caption_tag(const std::string& title, const std::string& caption) {
  return fmt::format("<figcaption><b>{}.</b> {}</figcaption>", html_escaped(title), html_escaped(caption));
}

std::string data_tag(const std::string& id, const std::string& bytes) {
  return fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", id, base64(bytes));
}

}  // namespace

void HtmlPage::heading(const std::string& text, const std::string& id) {
  contents_ += fmt::format("<a href=\"#{0}\">{1}</a>", html_escaped(id), html_escaped(text));
  body_ += fmt::format("<h2 id=\"{}\">{}</h2>\n", html_escaped(id), html_escaped(text));
}

void HtmlPage::subheading(const std::string& text) { body_ += fmt::format("<h3>{}</h3>\n", html_escaped(text)); }

void HtmlPage::paragraph(const std::string& text) { body_ += fmt::format("<p>{}</p>\n", html_escaped(text)); }

void HtmlPage::verdict(const std::string& text, bool good) {
  body_ += fmt::format("<div class=\"verdict {}\">{}</div>\n", good ? "good" : "bad", html_escaped(text));
}

void HtmlPage::table(const std::vector<std::string>& columns, const std::vector<std::vector<Cell>>& rows) {
  body_ += "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"table\"><table><thead><tr>";
  for (const auto& column : columns) body_ += "<th scope=\"col\">" + html_escaped(column) + "</th>";
  body_ += "</tr></thead>\n<tbody>";
  for (const auto& row : rows) {
    body_ += "<tr>";
    for (const auto& cell : row)
      body_ += fmt::format("<td{}>{}</td>", cell.mark.empty() ? "" : " class=\"" + cell.mark + "\"",
                           html_escaped(cell.text));
    body_ += "</tr>\n";
  }
  body_ += "</tbody></table></div>\n";
}

void HtmlPage::figure(const Figure& figure) {
  body_ += fmt::format("<figure>{}{}</figure>\n", image_tag(figure.image, figure.title + ". " + figure.caption),
                       caption_tag(figure.title, figure.caption));
}

void HtmlPage::comparison(const ImageComparison& comparison) {
  scripts_ = true;
  body_ += "<figure class=\"compare\"><div class=\"layers\">\n";
  for (const auto& [word, image] : {std::pair("New", &comparison.made), std::pair("Reference", &comparison.reference),
                                    std::pair("Difference", &comparison.difference)})
    body_ += fmt::format("<div class=\"layer\"><span>{}</span>{}</div>\n", word,
                         image_tag(*image, comparison.title + ", " + word));
  body_ += "</div>" + caption_tag(comparison.title, comparison.caption) + "</figure>\n";
}

void HtmlPage::model(const std::string& title, const std::string& glb) {
  static const std::string viewer = viewer_code_gzip();
  if (viewer.empty())
    return paragraph(title +
                     ": no 3D view, as the program was built without @google/model-viewer; the GLB files in out/ "
                     "hold the garments.");
  scripts_ = true;
  const std::string id = fmt::format("model-{}", ++models_);
  if (models_ == 1) body_ += data_tag("viewer-code", viewer);
  body_ += fmt::format(
               "<div class=\"model\" data-model=\"{}\" data-title=\"{}\"><noscript>{}: the 3D view needs "
               "scripts.</noscript></div>\n",
               id, html_escaped(title), html_escaped(title)) +
           data_tag(id, glb);
}

void HtmlPage::drawing(const std::string& title, const std::string& caption, const std::string& svg) {
  body_ += "<figure>" + svg + caption_tag(title, caption) + "</figure>\n";
}

void HtmlPage::preformatted(const std::string& summary, const std::string& text) {
  body_ +=
      fmt::format("<details><summary>{}</summary><pre>{}</pre></details>\n", html_escaped(summary), html_escaped(text));
}

std::string HtmlPage::text() const {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\"><meta http-equiv=\"Content-Security-Policy\" content=\"{4}\">"
      "<title>{0}</title><style>{1}</style></head>\n<body><a class=\"skip\" href=\"#content\">To the content</a>"
      "<header><h1>{0}</h1>\n<nav aria-label=\"Parts of this page\">{2}</nav></header>\n<main id=\"content\">{3}</main>"
      "{5}</body></html>\n",
      html_escaped(title_), kPageStyle, contents_, body_, kPagePolicy,
      scripts_ ? std::string("<script>") + kPageScript + "</script>" : "");
}

}  // namespace dressform
