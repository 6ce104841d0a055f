#pragma once
#include <filesystem>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "render/charts/canvas.h"

namespace dressform {

// Something to be drawn, whatever into: the same strokes as pixels, SVG or PDF.
struct Sheet {
  double width_mm = 0, height_mm = 0;
  std::string title;  // of the document, and for readers who cannot see it
  std::function<void(Canvas&)> paint;
};

// All of them: the same sheet, the same bytes; no dates inside.
std::string sheet_svg(const Sheet& sheet);
std::string sheet_pdf(const Sheet& sheet);                 // one page; letters as an embedded TrueType font, no Type 3
cv::Mat sheet_image(const Sheet& sheet, double dpi);       // 8-bit BGR
std::string sheet_png(const Sheet& sheet, double dpi);     // says its resolution
std::string png_at_dpi(const cv::Mat& image, double dpi);  // any image, likewise

const std::vector<std::string>& sheet_formats();  // "png", "pdf", "svg"

// stem.png, stem.pdf, ... in `folder`; the names of the files. Throws InputError where one cannot be written.
std::vector<std::string> write_sheet(const Sheet& sheet, const std::filesystem::path& folder, const std::string& stem,
                                     const std::vector<std::string>& formats, double dpi);

}  // namespace dressform
