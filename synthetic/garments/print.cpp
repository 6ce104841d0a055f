#include "synthetic/garments/print.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "scenes/error.h"
#include "scenes/random.h"
#include "synthetic/garments/weave.h"

namespace dressform {
namespace {

cv::Scalar parse_color(const std::string& text) {
  unsigned rgb = 0;
  bool good = text.size() == 7 && text[0] == '#';
  for (size_t i = 1; good && i < text.size(); ++i) {
    good = std::isxdigit(static_cast<unsigned char>(text[i])) != 0;
    const char c = static_cast<char>(std::tolower(static_cast<unsigned char>(text[i])));
    rgb = rgb * 16 + (c >= 'a' ? c - 'a' + 10 : c - '0');
  }
  if (!good) throw InputError("garment.print.colors", "found \"" + text + "\"; expected \"#rrggbb\"");
  return {double(rgb & 255), double(rgb >> 8 & 255), double(rgb >> 16)};
}

// What all painters need.
struct Canvas {
  cv::Mat image;
  double pixels_per_m;
  std::vector<cv::Scalar> colors;  // ground first; never empty
  std::string text;
  Seed seed;

  cv::Scalar color(size_t i) const { return colors[i < colors.size() ? i : colors.size() - 1]; }
  cv::Point2d middle() const { return {0.5 * image.cols, 0.5 * image.rows}; }
  double pixels(double metres) const { return metres * pixels_per_m; }
};

constexpr int kShift = 4;  // fixed-point bits of OpenCV's drawing functions
cv::Point fixed(const cv::Point2d& p) { return {cvRound(p.x * (1 << kShift)), cvRound(p.y * (1 << kShift))}; }

void fill_polygon(cv::Mat& image, const std::vector<cv::Point2d>& outline, const cv::Scalar& color) {
  std::vector<cv::Point> points;
  for (const auto& p : outline) points.push_back(fixed(p));
  cv::fillPoly(image, std::vector<std::vector<cv::Point>>{points}, color, cv::LINE_AA, kShift);
}

void draw_star(cv::Mat& image, const cv::Point2d& center, double radius, double turn, const cv::Scalar& color) {
  std::vector<cv::Point2d> outline;
  for (int i = 0; i < 10; ++i) {
    const double angle = turn + i * CV_PI / 5, r = i % 2 ? 0.42 * radius : radius;
    outline.emplace_back(center.x + r * std::sin(angle), center.y - r * std::cos(angle));
  }
  fill_polygon(image, outline, color);
}

constexpr int kFont = cv::FONT_HERSHEY_DUPLEX;
constexpr double kTextWidth = 0.25;  // at most, so that the front shows all of it, m

// Height of the text: the wanted one, or what its width leaves.
double fitting_height(const std::string& text, double wanted_m) {
  int baseline = 0;
  const cv::Size size = cv::getTextSize(text, kFont, 1, 3, &baseline);
  return std::min(wanted_m, kTextWidth * 21 / std::max(1, size.width));
}

// Text about a middle, `height_m` high, in strokes.
void draw_text(Canvas& canvas, const cv::Point2d& middle, double wanted_m, const cv::Scalar& color) {
  const double height_m = fitting_height(canvas.text, wanted_m);
  const double scale = canvas.pixels(height_m) / 21;
  const int thickness = std::max(1, cvRound(canvas.pixels(height_m) * 0.13));
  int baseline = 0;
  const cv::Size size = cv::getTextSize(canvas.text, kFont, scale, thickness, &baseline);
  cv::putText(canvas.image, canvas.text,
              cv::Point(cvRound(middle.x - size.width / 2.0), cvRound(middle.y + size.height / 2.0)), kFont, scale,
              color, thickness, cv::LINE_AA);
}

// Stars all over on a jittered lattice, and characters across the front.
void paint_stars(Canvas& canvas) {
  const double pitch = canvas.pixels(0.115);
  const cv::Point2d middle = canvas.middle();
  const int across = static_cast<int>(middle.x / pitch) + 2, down = static_cast<int>(middle.y / pitch) + 2;
  const double text_height = 0.075, text_y = middle.y - canvas.pixels(0.06);
  std::uint64_t index = 0;
  for (int j = -down; j <= down; ++j)
    for (int i = -across; i <= across; ++i) {
      const auto u = uniform4(canvas.seed, stream_of("stars"), index++);
      const cv::Point2d at(middle.x + pitch * (i + (j % 2 ? 0.5 : 0.0) + 0.25 * (u[0] - 0.5)),
                           middle.y + pitch * (j + 0.25 * (u[1] - 0.5)));
      const double half_text = canvas.pixels(0.5 * kTextWidth);
      const bool under_text = !canvas.text.empty() && std::abs(at.y - text_y) < canvas.pixels(0.075) &&
                              std::abs(at.x - middle.x) < half_text + canvas.pixels(0.03);
      if (under_text) continue;
      draw_star(canvas.image, at, canvas.pixels(0.014 + 0.018 * u[2]), 2 * CV_PI * u[3],
                canvas.color(1 + index % std::max<size_t>(1, canvas.colors.size() - 1)));
    }
  if (!canvas.text.empty()) draw_text(canvas, {middle.x, text_y}, text_height, canvas.color(1));
}

// A dense all-over print of leaves, rings, lozenges and strokes in all print colours.
void paint_complex(Canvas& canvas) {
  const double pitch = canvas.pixels(0.038);
  const cv::Point2d middle = canvas.middle();
  const int across = static_cast<int>(middle.x / pitch) + 2, down = static_cast<int>(middle.y / pitch) + 2;
  std::uint64_t index = 0;
  for (int j = -down; j <= down; ++j)
    for (int i = -across; i <= across; ++i) {
      const auto u = uniform4(canvas.seed, stream_of("complex"), index),
                 v = uniform4(canvas.seed, stream_of("motif"), index);
      ++index;
      const cv::Point2d at(middle.x + pitch * (i + 0.7 * (u[0] - 0.5)), middle.y + pitch * (j + 0.7 * (u[1] - 0.5)));
      const double size = canvas.pixels(0.008 + 0.014 * u[2]), turn = 360 * u[3];
      const size_t count = std::max<size_t>(1, canvas.colors.size() - 1);
      const cv::Scalar color = canvas.color(1 + std::min(count - 1, static_cast<size_t>(v[0] * count)));
      const int stroke = std::max(1, cvRound(0.28 * size));
      const int motif = static_cast<int>(v[1] * 4);
      if (motif == 0)
        cv::ellipse(canvas.image, fixed(at), fixed({size, 0.4 * size}), turn, 0, 360, color, cv::FILLED, cv::LINE_AA,
                    kShift);
      if (motif == 1)
        cv::circle(canvas.image, fixed(at), cvRound(0.8 * size * (1 << kShift)), color, stroke, cv::LINE_AA, kShift);
      if (motif == 2)
        fill_polygon(canvas.image,
                     {{at.x, at.y - size}, {at.x + 0.5 * size, at.y}, {at.x, at.y + size}, {at.x - 0.5 * size, at.y}},
                     color);
      if (motif == 3)
        cv::ellipse(canvas.image, fixed(at), fixed({1.2 * size, 0.8 * size}), turn, 20, 200, color, stroke, cv::LINE_AA,
                    kShift);
    }
  if (!canvas.text.empty()) draw_text(canvas, middle, 0.08, canvas.color(1));
}

// Two parallel stripes across the front, below the chest.
void paint_stripes(Canvas& canvas) {
  for (const double offset : {-0.055, 0.015}) {
    const double y = canvas.middle().y + canvas.pixels(offset - 0.03), half = canvas.pixels(0.018);
    cv::rectangle(canvas.image, cv::Point(0, cvRound(y - half)), cv::Point(canvas.image.cols - 1, cvRound(y + half)),
                  canvas.color(1), cv::FILLED);
  }
  if (!canvas.text.empty())
    draw_text(canvas, {canvas.middle().x, canvas.middle().y - canvas.pixels(0.16)}, 0.06, canvas.color(1));
}

// Characters strewn over the cloth, upright within a quarter turn, in all print colours.
void paint_characters(Canvas& canvas) {
  const std::string letters = canvas.text.empty() ? std::string("ABCDEFGHKLMNPRSTXYZ2345678&?") : canvas.text;
  const double pitch = canvas.pixels(0.075);
  const cv::Point2d middle = canvas.middle();
  const int across = static_cast<int>(middle.x / pitch) + 2, down = static_cast<int>(middle.y / pitch) + 2;
  const int side = std::max(8, cvRound(canvas.pixels(0.07)));
  std::uint64_t index = 0;
  for (int j = -down; j <= down; ++j)
    for (int i = -across; i <= across; ++i) {
      const auto u = uniform4(canvas.seed, stream_of("characters"), index++);
      const cv::Point2d at(middle.x + pitch * (i + 0.3 * (u[0] - 0.5)), middle.y + pitch * (j + 0.3 * (u[1] - 0.5)));
      const char letter = letters[std::min(letters.size() - 1, static_cast<size_t>(u[2] * letters.size()))];
      if (letter == ' ') continue;
      // The letter as a mask, turned, through which its colour is laid on.
      cv::Mat mask(side, side, CV_8U, cv::Scalar(0)), turned;
      const double scale = canvas.pixels(0.040) / 21;
      cv::putText(mask, std::string(1, letter),
                  cv::Point(cvRound(side / 2.0 - 10 * scale), cvRound(side / 2.0 + 10 * scale)), kFont, scale,
                  cv::Scalar(255), std::max(1, cvRound(3 * scale)), cv::LINE_AA);
      cv::warpAffine(mask, turned, cv::getRotationMatrix2D(cv::Point2f(side / 2.f, side / 2.f), 90 * (u[3] - 0.5), 1),
                     mask.size());
      const cv::Rect whole(cvRound(at.x) - side / 2, cvRound(at.y) - side / 2, side, side);
      const cv::Rect seen = whole & cv::Rect(0, 0, canvas.image.cols, canvas.image.rows);
      if (seen.empty()) continue;
      const size_t inks = std::max<size_t>(1, canvas.colors.size() - 1);
      canvas.image(seen).setTo(canvas.color(1 + index % inks), turned(seen - whole.tl()) > 127);
    }
}

// A small repeat that covers the whole cloth: flowers of six petals and dots between them.
void paint_all_over(Canvas& canvas) {
  const double pitch = canvas.pixels(0.045), petal = canvas.pixels(0.0065);
  const cv::Point2d middle = canvas.middle();
  const int across = static_cast<int>(middle.x / pitch) + 2, down = static_cast<int>(middle.y / pitch) + 2;
  const auto dot = [&](const cv::Point2d& at, double radius, const cv::Scalar& color) {
    cv::circle(canvas.image, fixed(at), std::max(1, cvRound(radius * (1 << kShift))), color, cv::FILLED, cv::LINE_AA,
               kShift);
  };
  for (int j = -down; j <= down; ++j)
    for (int i = -across; i <= across; ++i) {
      const cv::Point2d at(middle.x + pitch * (i + (j % 2 ? 0.5 : 0.0)), middle.y + pitch * j);
      const double turn = uniform(canvas.seed, stream_of("all over"), (j + down) * (2 * across + 1) + i + across);
      for (int k = 0; k < 6; ++k) {
        const double angle = CV_PI * (k + turn) / 3;
        dot(at + 1.5 * petal * cv::Point2d(std::cos(angle), std::sin(angle)), petal, canvas.color(1));
      }
      dot(at, 0.8 * petal, canvas.color(2));
      dot(at + cv::Point2d(0.5 * pitch, 0), 0.5 * petal, canvas.color(3));
    }
}

// Crossing bands, half transparent.
void paint_plaid(Canvas& canvas) {
  const cv::Mat ground = canvas.image.clone();
  for (int layer = 0; layer < 2; ++layer) {
    cv::Mat bands = canvas.image.clone();
    const double pitch = canvas.pixels(0.09), half = canvas.pixels(layer == 0 ? 0.014 : 0.004),
                 shift = layer * 0.5 * pitch;
    for (double x = std::fmod(canvas.middle().x, pitch) - pitch + shift; x < bands.cols; x += pitch)
      cv::rectangle(bands, cv::Point2d(x - half, 0), cv::Point2d(x + half, bands.rows), canvas.color(1 + layer),
                    cv::FILLED);
    cv::addWeighted(canvas.image, 0.5, bands, 0.5, 0, canvas.image);
    bands = canvas.image.clone();
    for (double y = std::fmod(canvas.middle().y, pitch) - pitch + shift; y < bands.rows; y += pitch)
      cv::rectangle(bands, cv::Point2d(0, y - half), cv::Point2d(bands.cols, y + half), canvas.color(1 + layer),
                    cv::FILLED);
    cv::addWeighted(canvas.image, 0.5, bands, 0.5, 0, canvas.image);
  }
}

void paint_nothing(Canvas&) {}

void paint_text(Canvas& canvas) {
  if (!canvas.text.empty())
    draw_text(canvas, {canvas.middle().x, canvas.middle().y - canvas.pixels(0.06)}, 0.08, canvas.color(1));
}

// Random patches in all colours, large ones over fine ones.
void paint_noise(Canvas& canvas) {
  const cv::Size size = canvas.image.size();
  for (size_t i = 1; i < canvas.colors.size(); ++i) {
    const double grain = canvas.pixels(i % 2 ? 0.030 : 0.012);
    const cv::Mat value = smooth_noise(size, grain, grain, canvas.seed + i, stream_of("noise patches")) +
                          0.5 * smooth_noise(size, 0.3 * grain, 0.3 * grain, canvas.seed + i, stream_of("noise edges"));
    canvas.image.setTo(canvas.colors[i], value > 0.45);
  }
}

struct Kind {
  const char* name;
  void (*paint)(Canvas&);
  double yarn_contrast, dye_contrast;
};
const Kind kKinds[] = {
    {"plain", paint_text, 0.030, 0.015},        {"stars", paint_stars, 0.025, 0.012},
    {"complex", paint_complex, 0.025, 0.012},   {"stripes", paint_stripes, 0.030, 0.015},
    {"plaid", paint_plaid, 0.030, 0.012},       {"denim", paint_nothing, 0.10, 0.05},
    {"weave", paint_nothing, 0.12, 0.02},       {"characters", paint_characters, 0.025, 0.012},
    {"all_over", paint_all_over, 0.025, 0.012}, {"noise", paint_noise, 0.03, 0.012},
};

}  // namespace

cv::Mat paint_print(const PrintSpec& spec, double width_m, double height_m, double pixels_per_m, Seed seed) {
  const Kind* kind = nullptr;
  std::string known;
  for (const Kind& each : kKinds) {
    known += (known.empty() ? "" : ", ") + std::string(each.name);
    if (spec.kind == each.name) kind = &each;
  }
  if (!kind) throw InputError("garment.print.kind", "found \"" + spec.kind + "\"; expected one of " + known);
  Canvas canvas;
  canvas.pixels_per_m = pixels_per_m;
  canvas.text = spec.text;
  canvas.seed = seed;
  for (const std::string& color : spec.colors) canvas.colors.push_back(parse_color(color));
  if (canvas.colors.empty()) canvas.colors.push_back(cv::Scalar(150, 140, 130));
  if (canvas.colors.size() == 1) canvas.colors.push_back(cv::Scalar(240, 240, 240));
  const cv::Size size(std::max(1, cvCeil(width_m * pixels_per_m)), std::max(1, cvCeil(height_m * pixels_per_m)));
  canvas.image = cv::Mat(size, CV_8UC3, canvas.colors[0]);
  kind->paint(canvas);
  return woven(canvas.image, pixels_per_m, kind->yarn_contrast, kind->dye_contrast, seed);
}

}  // namespace dressform
