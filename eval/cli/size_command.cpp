#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "eval/cli/commands.h"
#include "eval/cli/end_to_end_progress.h"
#include "eval/cli/options.h"
#include "eval/wardrobe/graded_body.h"
#include "eval/wardrobe/sizes.h"
#include "eval/wardrobe/wardrobe_picture.h"
#include "scenes/file_bytes.h"
#include "scenes/mesh_io.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct SizeOptions : CommonOptions {
  fs::path run;
  std::string chart = "men", customer;
  int height = 600;
  MeshFrame frame;
};

// Who the best size is for: as asked, else the run's own user; nobody where there is neither.
std::optional<Customer> wearer(const SizeOptions& options, const CapturedClothes& clothes) {
  if (!options.customer.empty()) return customer_of(options.customer, options.frame);
  if (clothes.user) return Customer{clothes.name, *clothes.user};
  return {};
}

std::string sizes_json(const CapturedClothes& clothes, const std::vector<SizedClothes>& sizes,
                       const std::vector<SizeEase>& eases, const std::optional<Customer>& customer) {
  ordered_json json{{"run", clothes.name}, {"sizes", ordered_json::array()}};
  for (const SizedClothes& sized : sizes) {
    ordered_json scores = ordered_json::array();
    for (const DressedScore& score : sized.clothes.scores)
      scores.push_back({{"slot", score.slot}, {"metric", score.metric}, {"unit", score.unit}, {"value", score.value}});
    json["sizes"].push_back({{"size", sized.size.name},
                             {"chest_m", sized.size.chest_m},
                             {"waist_m", sized.size.waist_m},
                             {"hip_m", sized.size.hip_m},
                             {"scores", scores}});
  }
  if (customer) {
    const BodyGirths girths = girths_of(customer->body.body, customer->name);
    json["customer"] = {{"name", customer->name},
                        {"chest_m", girths.chest_m},
                        {"waist_m", girths.waist_m},
                        {"hip_m", girths.hip_m},
                        {"best", best_sizes(eases)}};
    for (const SizeEase& each : eases)
      json["customer"]["ease"].push_back({{"slot", each.slot},
                                          {"size", each.size},
                                          {"tape", each.tape},
                                          {"garment_girth_mm", each.garment_girth_mm},
                                          {"ease_mm", each.ease_mm},
                                          {"meant_mm", each.meant_mm}});
  }
  return json.dump(1) + "\n";
}

void write_picture(const std::vector<SizedClothes>& sizes, const std::map<std::string, std::string>& best, int height,
                   const fs::path& file) {
  std::vector<PicturedBody> row;
  for (const SizedClothes& sized : sizes) {
    std::string caption = sized.size.name;
    for (const auto& [slot, size] : best)
      if (size == sized.size.name) caption += ": best " + slot;
    row.push_back({&sized.body, &sized.clothes, caption});
  }
  std::vector<unsigned char> bytes;
  cv::imencode(".png", wardrobe_picture({row}, height), bytes);
  write_file_atomically(file, std::string(bytes.begin(), bytes.end()));
}

void print_eases(const std::vector<SizeEase>& eases, const std::map<std::string, std::string>& best) {
  for (const SizeEase& each : eases)
    fmt::print("{:<8}{:<5}{:<7}girth {:7.0f} mm, ease {:+6.0f} mm (cut with {:+.0f} mm){}\n", each.slot, each.size,
               each.tape, each.garment_girth_mm, each.ease_mm, each.meant_mm,
               best.at(each.slot) == each.size ? "  <- best" : "");
}

int make_sizes(SizeOptions options) {
  const ThreadLimit threads(options.threads);
  if (options.output.empty()) options.output = options.run / "sizes";
  Progress progress(options.quiet);
  const CapturedClothes clothes = captured_clothes(options.run, end_to_end_progress(progress).stage);
  const std::optional<Customer> customer = wearer(options, clothes);
  std::vector<SizedClothes> sizes;
  long pairs = 0;
  for (const SizeClass& size : size_chart(options.chart)) {
    progress.update("size " + size.name);
    sizes.push_back(clothes_in_size(clothes, size));
    pairs += sizes.back().clothes.intersecting_pairs;
    const fs::path folder = options.output / size.name;
    fs::create_directories(folder);
    for (const auto& [slot, garment] : sizes.back().clothes.garments) write_glb(folder / (slot + ".glb"), garment);
    progress.finish("size " + size.name,
                    fmt::format("{} pairs of triangles cut", sizes.back().clothes.intersecting_pairs));
  }
  std::vector<SizeEase> eases;
  if (customer) eases = size_eases(clothes, sizes, customer->body.body);
  const auto best = best_sizes(eases);
  write_file_atomically(options.output / "sizes.json", sizes_json(clothes, sizes, eases, customer));
  write_picture(sizes, best, options.height, options.output / "sizes.png");
  print_eases(eases, best);
  fmt::print("{}, {} intersecting pairs in all\n", (options.output / "sizes.png").string(), pairs);
  return kSuccess;
}

Command add_size_command(CLI::App& app) {
  auto options = std::make_shared<SizeOptions>();
  auto* command =
      app.add_subcommand("size", "A run's clothes in the sizes XS to XXL, and which fits a customer best (EN 13402)");
  command->add_option("run", options->run, "run folder")->required();
  command->add_option("-o,--output", options->output,
                      "folder for sizes.png, sizes.json and a GLB a size and garment; default RUN/sizes");
  command->add_option("--chart", options->chart, "whose sizes (default men)")->check(CLI::IsMember({"men", "women"}));
  command->add_option("--customer", options->customer,
                      "whom the best size is for: a run, a scene or a closed body's mesh; default the run's own user");
  command->add_option("--height", options->height, "pixels of one body in the picture (default 600)")
      ->check(CLI::Range(64, 4096));
  add_mesh_frame(*command, options->frame);
  add_threads(*command, *options);
  command->footer("Example:\n  dressform size runs/group1 --chart men -o sizes/group1");
  return [options] { return make_sizes(*options); };
}

const RegisteredCommand registered_size{72, add_size_command};

}  // namespace
}  // namespace dressform
