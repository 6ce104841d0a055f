#include "eval/report/html.h"

#include <fmt/format.h>

#include <opencv2/imgcodecs.hpp>

namespace dressform {
namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light; }
body { font: 15px/1.5 system-ui, "Segoe UI", sans-serif; color: #222; background: #fff; margin: 0 auto; padding: 24px;
       max-width: 1240px; }
h1 { font-size: 26px; margin: 0 0 4px; } h2 { font-size: 20px; margin: 36px 0 8px; border-bottom: 1px solid #ddd; }
h3 { font-size: 16px; margin: 20px 0 6px; }
nav { font-size: 13px; color: #666; } nav a { color: #25619b; margin-right: 12px; text-decoration: none; }
.verdict { padding: 10px 14px; border-radius: 6px; margin: 14px 0; font-weight: 600; }
.verdict.good { background: #e3f3e5; color: #1b5e20; } .verdict.bad { background: #fdeaea; color: #9b1c1c; }
table { border-collapse: collapse; font-size: 13.5px; margin: 8px 0 14px; font-variant-numeric: tabular-nums; }
th { text-align: left; font-weight: 600; border-bottom: 2px solid #bbb; padding: 4px 14px 4px 0; }
td { border-bottom: 1px solid #eee; padding: 3px 14px 3px 0; white-space: nowrap; }
td.good { color: #1b5e20; } td.bad { color: #b00020; font-weight: 600; } td.quiet { color: #888; }
figure { margin: 10px 0 18px; } figure img, figure svg { max-width: 100%; height: auto; border: 1px solid #eee; }
figcaption { font-size: 13px; color: #555; } figcaption b { color: #222; }
pre { font-size: 12px; background: #f7f7f7; padding: 10px; overflow-x: auto; }
summary { cursor: pointer; color: #25619b; }
)";

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
  body_ += "<table><tr>";
  for (const auto& column : columns) body_ += "<th>" + html_escaped(column) + "</th>";
  body_ += "</tr>\n";
  for (const auto& row : rows) {
    body_ += "<tr>";
    for (const auto& cell : row)
      body_ += fmt::format("<td{}>{}</td>", cell.mark.empty() ? "" : " class=\"" + cell.mark + "\"",
                           html_escaped(cell.text));
    body_ += "</tr>\n";
  }
  body_ += "</table>\n";
}

void HtmlPage::figure(const Figure& figure) {
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", figure.image, bytes, {cv::IMWRITE_JPEG_QUALITY, 90});
  body_ += fmt::format(
      "<figure><img alt=\"{0}\" src=\"data:image/jpeg;base64,{1}\"><figcaption><b>{0}.</b> {2}</figcaption></figure>\n",
      html_escaped(figure.title), base64(std::string(bytes.begin(), bytes.end())), html_escaped(figure.caption));
}

void HtmlPage::drawing(const std::string& title, const std::string& caption, const std::string& svg) {
  body_ += fmt::format("<figure>{}<figcaption><b>{}.</b> {}</figcaption></figure>\n", svg, html_escaped(title),
                       html_escaped(caption));
}

void HtmlPage::preformatted(const std::string& summary, const std::string& text) {
  body_ +=
      fmt::format("<details><summary>{}</summary><pre>{}</pre></details>\n", html_escaped(summary), html_escaped(text));
}

std::string HtmlPage::text() const {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>{0}</title><style>{1}</style></head>\n<body><h1>{0}</h1>\n"
      "<nav>{2}</nav>\n{3}</body></html>\n",
      html_escaped(title_), kStyle, contents_, body_);
}

}  // namespace dressform
