#include "render/charts/sheet.h"

#include <cairo/cairo-pdf.h>
#include <cairo/cairo.h>

#include <boost/crc.hpp>
#include <cmath>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "render/charts/cairo_canvas.h"
#include "render/charts/style.h"
#include "render/charts/svg_canvas.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

constexpr double kPointsPerMm = 72 / kMmPerInch;
constexpr const char* kNoDate = "2000-01-01T00:00:00Z";  // Cairo would write today's

using SheetSurface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using SheetContext = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

void require(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) throw std::runtime_error(std::string("cairo: ") + cairo_status_to_string(status));
}

// Paints into a surface with so many of its units a millimetre.
void paint_into(cairo_surface_t* surface, double units_per_mm, const Sheet& sheet) {
  const SheetContext context(cairo_create(surface), cairo_destroy);
  cairo_set_source_rgb(context.get(), 1, 1, 1);
  cairo_paint(context.get());
  cairo_scale(context.get(), units_per_mm, units_per_mm);
  CairoCanvas canvas(context.get());
  sheet.paint(canvas);
  require(cairo_status(context.get()));
}

cairo_status_t append_bytes(void* to, const unsigned char* bytes, unsigned count) {
  static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
  return bytes;
}

}  // namespace

std::string sheet_svg(const Sheet& sheet) {
  SvgCanvas canvas(sheet.width_mm, sheet.height_mm, sheet.title);
  sheet.paint(canvas);
  return canvas.svg();
}

std::string sheet_pdf(const Sheet& sheet) {
  std::string bytes;
  const SheetSurface surface(cairo_pdf_surface_create_for_stream(append_bytes, &bytes, kPointsPerMm * sheet.width_mm,
                                                                 kPointsPerMm * sheet.height_mm),
                             cairo_surface_destroy);
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, sheet.title.c_str());
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, kNoDate);
  paint_into(surface.get(), kPointsPerMm, sheet);
  cairo_surface_finish(surface.get());
  require(cairo_surface_status(surface.get()));
  return bytes;
}

cv::Mat sheet_image(const Sheet& sheet, double dpi) {
  const double pixels_per_mm = dpi / kMmPerInch;
  cv::Mat pixels(static_cast<int>(std::lround(pixels_per_mm * sheet.height_mm)),
                 static_cast<int>(std::lround(pixels_per_mm * sheet.width_mm)), CV_8UC4),
      bgr;
  const SheetSurface surface(cairo_image_surface_create_for_data(pixels.data, CAIRO_FORMAT_RGB24, pixels.cols,
                                                                 pixels.rows, static_cast<int>(pixels.step)),
                             cairo_surface_destroy);
  require(cairo_surface_status(surface.get()));
  paint_into(surface.get(), pixels_per_mm, sheet);
  cairo_surface_flush(surface.get());
  cv::cvtColor(pixels, bgr, cv::COLOR_BGRA2BGR);
  return bgr;
}

std::string png_at_dpi(const cv::Mat& image, double dpi) {
  std::vector<unsigned char> encoded;
  cv::imencode(".png", image, encoded);
  std::string bytes(encoded.begin(), encoded.end());
  const auto per_metre = static_cast<std::uint32_t>(std::lround(1000 * dpi / kMmPerInch));
  const std::string chunk = "pHYs" + big_endian(per_metre) + big_endian(per_metre) + std::string(1, '\1');
  boost::crc_32_type sum;
  sum.process_bytes(chunk.data(), chunk.size());
  constexpr std::size_t kAfterHeader = 8 + 25;  // signature, and the IHDR chunk that always comes first
  return bytes.insert(kAfterHeader, big_endian(9) + chunk + big_endian(sum.checksum()));
}

std::string sheet_png(const Sheet& sheet, double dpi) { return png_at_dpi(sheet_image(sheet, dpi), dpi); }

const std::vector<std::string>& sheet_formats() {
  static const std::vector<std::string> formats{"png", "pdf", "svg"};
  return formats;
}

std::vector<std::string> write_sheet(const Sheet& sheet, const std::filesystem::path& folder, const std::string& stem,
                                     const std::vector<std::string>& formats, double dpi) {
  std::vector<std::string> files;
  for (const auto& format : formats) {
    files.push_back(stem + "." + format);
    write_file_atomically(folder / files.back(), format == "pdf"   ? sheet_pdf(sheet)
                                                 : format == "svg" ? sheet_svg(sheet)
                                                                   : sheet_png(sheet, dpi));
  }
  return files;
}

}  // namespace dressform
