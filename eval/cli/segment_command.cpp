#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <opencv2/core.hpp>

#include "eval/cli/commands.h"
#include "eval/cli/options.h"
#include "eval/report/jseg_images.h"
#include "scenes/file_bytes.h"
#include "scenes/image_file.h"
#include "scenes/json_file.h"
#include "scenes/new_folder.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

constexpr double kMostPixels = 1 << 25;  // some 3 GB of memory
constexpr std::size_t kMostBytes = std::size_t{1} << 30;

struct SegmentOptions : CommonOptions {
  fs::path image, mask;
  JsegParams params;
};

struct Input {
  cv::Mat bgr, mask;  // mask: empty for the whole image
};

Input read_input(const SegmentOptions& options) {
  const std::string where = options.image.string();
  const TextureImage image = decode_texture(where, read_file_bytes(options.image, kMostBytes));
  if (static_cast<double>(image.bgr.total()) > kMostPixels)
    throw InputError(where, fmt::format("found an image of {} x {}; expected {:.0f} million pixels at most: make it "
                                        "smaller",
                                        image.bgr.cols, image.bgr.rows, kMostPixels / 1e6));
  Input input{image.bgr, {}};
  if (!image.alpha.empty()) input.mask = image.alpha >= 128;
  if (!options.mask.empty()) {
    const cv::Mat drawn = read_image(options.mask, kIndexImage, image.bgr.size()) != 0;
    input.mask = input.mask.empty() ? drawn : cv::Mat(input.mask & drawn);
  }
  if (!input.mask.empty() && cv::countNonZero(input.mask) == 0)
    throw InputError(
        options.mask.empty() ? where : options.mask.string(),
        "leaves no pixel to look at; expected a mask that is not 0, and an image that is opaque, somewhere");
  return input;
}

// Each region: label, pixels, bounding box, mean colour.
nlohmann::ordered_json description(const Input& input, const JsegResult& found, const JsegParams& params) {
  struct Region {
    int pixels = 0, left = 1 << 30, top = 1 << 30, right = -1, bottom = -1;
    cv::Vec3d sum{0, 0, 0};
  };
  std::vector<Region> regions(static_cast<std::size_t>(found.region_count) + 1);
  for (int y = 0; y < found.regions.rows; ++y) {
    for (int x = 0; x < found.regions.cols; ++x) {
      Region& region = regions[found.regions.at<int>(y, x)];
      ++region.pixels;
      region.left = std::min(region.left, x), region.right = std::max(region.right, x);
      region.top = std::min(region.top, y), region.bottom = std::max(region.bottom, y);
      region.sum += input.bgr.at<cv::Vec3b>(y, x);
    }
  }
  nlohmann::ordered_json json{{"format", "dressform-jseg"},
                              {"version", 1},
                              {"width", input.bgr.cols},
                              {"height", input.bgr.rows},
                              {"color_threshold", params.colors.threshold},
                              {"classes_asked", params.colors.classes},
                              {"scales", params.scales},
                              {"merge", params.merge},
                              {"classes", found.colors.count()}};
  json["regions"] = nlohmann::ordered_json::array();
  for (int label = 1; label <= found.region_count; ++label) {
    const Region& r = regions[label];
    const auto mean = [&](int c) { return std::lround(r.sum[c] / r.pixels); };
    json["regions"].push_back({{"label", label},
                               {"pixels", r.pixels},
                               {"box", {r.left, r.top, r.right - r.left + 1, r.bottom - r.top + 1}},
                               {"mean_rgb", {mean(2), mean(1), mean(0)}}});
  }
  return json;
}

// A folder of everything, or a PNG with the rest beside it: map.png, map_overlay.png, map_classes.png, ...
void write_result(const SegmentOptions& options, const Input& input, const JsegResult& found) {
  const cv::Mat map = label_image_16bit(options.image.string(), found.regions);
  const cv::Mat classes = label_image_16bit(options.image.string(), found.colors.classes + 1);
  auto images = jseg_images(input.bgr, found);
  images.emplace_back("class_map", classes);
  const auto json = description(input, found, options.params);
  if (options.output.extension() == ".png") {
    const fs::path stem = options.output.parent_path() / options.output.stem();
    for (const auto& [name, image] : images) write_png(stem.string() + "_" + name + ".png", image);
    write_json(stem.string() + ".json", json);
    write_png(options.output, map);
    return;
  }
  NewFolder folder(options.output);
  write_png(folder.temporary() / "regions.png", map);
  for (const auto& [name, image] : images) write_png(folder.temporary() / (name + ".png"), image);
  write_json(folder.temporary() / "regions.json", json);
  folder.keep();
}

int segment(const SegmentOptions& options) {
  const ThreadLimit threads(options.threads);
  if (fs::exists(options.output))
    throw InputError("-o " + options.output.string(), "exists already; expected the name of a new folder or PNG");
  const Input input = read_input(options);
  const auto start = std::chrono::steady_clock::now();
  const JsegResult found = jseg(input.bgr, input.mask, options.params);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  write_result(options, input, found);
  fmt::print("{}: {} x {} px, {} colour classes, {} scales, {} regions ({} before merging), {:.2f} s\n",
             options.image.string(), input.bgr.cols, input.bgr.rows, found.colors.count(), found.j.size(),
             found.region_count, found.unmerged_count, took.count());
  fmt::print("regions: {}\n",
             (options.output.extension() == ".png" ? options.output : options.output / "regions.png").string());
  return kSuccess;
}

Command add_segment_command(CLI::App& app) {
  auto options = std::make_shared<SegmentOptions>();
  JsegParams& params = options->params;
  auto* command = app.add_subcommand("segment", "Regions of even colour and texture in any image (JSEG)");
  command->add_option("image", options->image, "PNG or JPEG; grey and 16 bits, too; what is transparent is left out")
      ->required();
  command
      ->add_option("-o,--output", options->output,
                   "a new folder, or a PNG for the region map: the other images go beside it")
      ->required();
  command->add_option("--mask", options->mask, "8-bit grey PNG of the image's size: where it is 0 is left out");
  command
      ->add_option("--classes", params.colors.classes,
                   "number of colour classes, 1 to 256 (default 0: as many as --color-threshold leaves)")
      ->check(CLI::Range(0, 256));
  command
      ->add_option(
          "--color-threshold", params.colors.threshold,
          "squared CIE L*u*v* distance up to which colours are one class, 0 to 600 (default 0: found by itself)")
      ->check(CLI::Range(0.0, 600.0));
  command
      ->add_option("--scales", params.scales,
                   "passes, each at a finer scale: 1 coarse, 4 small regions in a large image (default 2)")
      ->check(CLI::Range(1, 4));
  command
      ->add_option("--merge", params.merge,
                   "distance of two regions' class histograms below which they become one (default 0.4; 0 merges none)")
      ->check(CLI::Range(0.0, 1.42));
  add_threads(*command, *options);
  command->footer(
      "Writes regions.png (16-bit labels from 1 on; 0: left out), regions.json (pixels, box and mean colour of each),\n"
      "overlay.png (borders), unmerged.png (borders before merging), class_map.png (16-bit labels), classes.png,\n"
      "j_scale1.png ... (the finest first; white: J >= 1) and valleys.png (where regions began).\n"
      "Deng and Manjunath, Unsupervised segmentation of color-texture regions in images and video, PAMI 2001.\n"
      "Example:\n"
      "  dressform segment zebra.jpg -o zebra_regions\n"
      "  dressform segment zebra.jpg -o zebra.png --classes 12 --scales 3 --merge 0.3");
  return [options] { return segment(*options); };
}

const RegisteredCommand registered_segment{75, add_segment_command};

}  // namespace
}  // namespace dressform
