#include "render/charts/cairo_canvas.h"

#include <cairo/cairo.h>

#include <memory>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "render/charts/style.h"

namespace dressform {
namespace {

using SurfacePtr = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using ContextPtr = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) throw std::runtime_error(std::string("cairo: ") + cairo_status_to_string(status));
}

// Letters where they are meant to be whatever the resolution, and the same pixels on every machine: no hinting, no
// subpixels.
void choose_font(cairo_t* context, double size, bool bold) {
  cairo_select_font_face(context, kFontFamily, CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, size);
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context, options);
  cairo_font_options_destroy(options);
}

double advance(cairo_t* context, const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(context, text.c_str(), &extents);
  return extents.x_advance;
}

}  // namespace

void CairoCanvas::set(const Ink& ink) {
  cairo_set_source_rgba(context_, ink.red / 255.0, ink.green / 255.0, ink.blue / 255.0, ink.opacity);
}

void CairoCanvas::trace(const Points& points) {
  cairo_new_path(context_);
  for (const auto& p : points) cairo_line_to(context_, p.x(), p.y());  // the first one moves
}

void CairoCanvas::polyline(const Points& points, const Ink& ink, double width_mm, bool dashed) {
  if (points.size() < 2) return;
  trace(points);
  set(ink);
  cairo_set_line_width(context_, width_mm);
  cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
  const double pattern[] = {kDashOn * width_mm, kDashOff * width_mm};
  cairo_set_dash(context_, pattern, dashed ? 2 : 0, 0);
  cairo_stroke(context_);
}

void CairoCanvas::polygon(const Points& points, const Ink& ink) {
  if (points.size() < 3) return;
  trace(points);
  cairo_close_path(context_);
  set(ink);
  cairo_fill(context_);
}

void CairoCanvas::dot(const Eigen::Vector2d& centre, double radius_mm, const Ink& ink) {
  cairo_new_path(context_);
  cairo_arc(context_, centre.x(), centre.y(), radius_mm, 0, 2 * M_PI);
  set(ink);
  cairo_fill(context_);
}

void CairoCanvas::text(const Eigen::Vector2d& at, const std::string& text, const Lettering& lettering) {
  cairo_save(context_);
  choose_font(context_, lettering.size_mm, lettering.bold);
  set(lettering.ink);
  cairo_translate(context_, at.x(), at.y());
  if (lettering.upward) cairo_rotate(context_, -M_PI / 2);
  const double back = lettering.anchor == Lettering::left ? 0 : lettering.anchor == Lettering::middle ? 0.5 : 1;
  cairo_move_to(context_, -back * advance(context_, text), 0);
  cairo_show_text(context_, text.c_str());
  cairo_restore(context_);
  check(cairo_status(context_));
}

void CairoCanvas::picture(const Eigen::Vector2d& corner, const Eigen::Vector2d& size_mm, const cv::Mat& bgr) {
  if (bgr.empty()) return;
  cv::Mat pixels;
  cv::cvtColor(bgr, pixels, cv::COLOR_BGR2BGRA);  // cairo's RGB24 on machines that count bytes from the low end
  const SurfacePtr image(cairo_image_surface_create_for_data(pixels.data, CAIRO_FORMAT_RGB24, pixels.cols, pixels.rows,
                                                             static_cast<int>(pixels.step)),
                         cairo_surface_destroy);
  check(cairo_surface_status(image.get()));
  cairo_save(context_);
  cairo_translate(context_, corner.x(), corner.y());
  cairo_scale(context_, size_mm.x() / pixels.cols, size_mm.y() / pixels.rows);
  cairo_rectangle(context_, 0, 0, pixels.cols, pixels.rows);
  cairo_clip(context_);
  cairo_set_source_surface(context_, image.get(), 0, 0);
  cairo_pattern_set_filter(cairo_get_source(context_), CAIRO_FILTER_GOOD);
  if (cairo_surface_get_type(cairo_get_target(context_)) == CAIRO_SURFACE_TYPE_IMAGE)  // else a seam, pale or of copies
    cairo_pattern_set_extend(cairo_get_source(context_), CAIRO_EXTEND_PAD);
  cairo_paint(context_);
  cairo_restore(context_);
  // A vector surface keeps what it was given until it is finished: it takes a copy of the pixels now.
  cairo_surface_finish(image.get());
  check(cairo_status(context_));
}

double text_width_mm(const std::string& text, double size_mm, bool bold) {
  const SurfacePtr surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1), cairo_surface_destroy);
  const ContextPtr context(cairo_create(surface.get()), cairo_destroy);
  constexpr double kUnits = 100;  // a millimetre of text is too small for the font's own rounding
  choose_font(context.get(), kUnits * size_mm, bold);
  const double width = advance(context.get(), text) / kUnits;
  check(cairo_status(context.get()));
  return width;
}

void write_text(cv::Mat& bgr, const Eigen::Vector2d& at_px, const std::string& text, double size_px, const Ink& ink) {
  if (bgr.empty() || bgr.type() != CV_8UC3) throw std::invalid_argument("write_text: an 8-bit BGR image is needed");
  cv::Mat pixels;
  cv::cvtColor(bgr, pixels, cv::COLOR_BGR2BGRA);
  const SurfacePtr surface(cairo_image_surface_create_for_data(pixels.data, CAIRO_FORMAT_RGB24, pixels.cols,
                                                               pixels.rows, static_cast<int>(pixels.step)),
                           cairo_surface_destroy);
  const ContextPtr context(cairo_create(surface.get()), cairo_destroy);
  Lettering lettering;
  lettering.size_mm = size_px;
  lettering.ink = ink;
  CairoCanvas(context.get()).text(at_px, text, lettering);
  cairo_surface_flush(surface.get());
  cv::cvtColor(pixels, bgr, cv::COLOR_BGRA2BGR);
}

}  // namespace dressform
