#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "eval/cli/commands.h"
#include "eval/cli/end_to_end_progress.h"
#include "eval/cli/options.h"
#include "eval/wardrobe/wardrobe_picture.h"
#include "scenes/file_bytes.h"
#include "scenes/mesh_io.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct DressOptions : CommonOptions {
  std::vector<fs::path> garments, bodies;
  int height = 420;
  MeshFrame frame;
};

// Clothes on bodies: a row for each run, a column for each body.
using Wardrobe = std::vector<std::vector<Dressed>>;

std::string csv_line(const std::string& clothes, const std::string& body, const DressedScore& score) {
  return fmt::format("{},{},{},{},{},{:.9g}\n", clothes, body, score.slot, score.metric, score.unit, score.value);
}

void write_scores(const std::vector<CapturedClothes>& clothes, const std::vector<Customer>& customers,
                  const Wardrobe& wardrobe, const fs::path& folder) {
  std::string csv = "garments,body,slot,metric,unit,value\n";
  ordered_json json = ordered_json::array();
  for (std::size_t r = 0; r < clothes.size(); ++r)
    for (std::size_t c = 0; c < customers.size(); ++c)
      for (const DressedScore& score : wardrobe[r][c].scores) {
        csv += csv_line(clothes[r].name, customers[c].name, score);
        json.push_back({{"garments", clothes[r].name},
                        {"body", customers[c].name},
                        {"slot", score.slot},
                        {"metric", score.metric},
                        {"unit", score.unit},
                        {"value", score.value}});
      }
  write_file_atomically(folder / "dress.csv", csv);
  write_file_atomically(folder / "dress.json", json.dump(1) + "\n");
}

void write_matrix(const std::vector<CapturedClothes>& clothes, const std::vector<Customer>& customers,
                  const Wardrobe& wardrobe, int height, const fs::path& file) {
  std::vector<std::vector<PicturedBody>> rows;
  for (std::size_t r = 0; r < clothes.size(); ++r) {
    rows.emplace_back();
    for (std::size_t c = 0; c < customers.size(); ++c)
      rows.back().push_back({&customers[c].body, &wardrobe[r][c], clothes[r].name + " on " + customers[c].name});
  }
  std::vector<unsigned char> bytes;
  cv::imencode(".png", wardrobe_picture(rows, height), bytes);
  write_file_atomically(file, std::string(bytes.begin(), bytes.end()));
}

// Names that are alike would write over one another: the later ones are numbered.
template <class Named>
void make_names_differ(std::vector<Named>& all) {
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (all[k].name == all[i].name) all[i].name += "_" + std::to_string(i + 1);
}

int dress_bodies(const DressOptions& options) {
  const ThreadLimit threads(options.threads);
  Progress progress(options.quiet);
  std::vector<CapturedClothes> clothes;
  std::vector<Customer> customers;
  for (const fs::path& run : options.garments)
    clothes.push_back(captured_clothes(run, end_to_end_progress(progress).stage));
  for (const fs::path& body : options.bodies) customers.push_back(customer_of(body, options.frame));
  make_names_differ(clothes);
  make_names_differ(customers);

  Wardrobe wardrobe;
  long pairs = 0;
  for (const CapturedClothes& each : clothes) {
    wardrobe.emplace_back();
    for (const Customer& customer : customers) {
      const std::string what = each.name + " on " + customer.name;
      progress.update(what);
      wardrobe.back().push_back(dressed(each, customer.body));
      const Dressed& made = wardrobe.back().back();
      pairs += made.intersecting_pairs;
      const fs::path folder = options.output / (each.name + "_on_" + customer.name);
      fs::create_directories(folder);
      for (const auto& [slot, garment] : made.garments) write_glb(folder / (slot + ".glb"), garment);
      write_ply(folder / "body.ply", customer.body.body);
      progress.finish(what, fmt::format("{} pairs of triangles cut", made.intersecting_pairs));
    }
  }
  write_scores(clothes, customers, wardrobe, options.output);
  write_matrix(clothes, customers, wardrobe, options.height, options.output / "dress.png");
  fmt::print("{}: {} captures on {} bodies, {} intersecting pairs\n", (options.output / "dress.png").string(),
             clothes.size(), customers.size(), pairs);
  return kSuccess;
}

Command add_dress_command(CLI::App& app) {
  auto options = std::make_shared<DressOptions>();
  auto* command = app.add_subcommand("dress", "The clothes of runs on other bodies: every garment on everybody");
  command->add_option("--garment", options->garments, "run folders whose clothes are worn")->required();
  command
      ->add_option("--body", options->bodies,
                   "who wears them: run folders (their users), scene files (their users) or closed bodies' meshes")
      ->required();
  command
      ->add_option("-o,--output", options->output,
                   "folder for dress.png, dress.csv, dress.json, and a folder of GLB for each pair")
      ->required();
  command->add_option("--height", options->height, "pixels of one body in the picture (default 420)")
      ->check(CLI::Range(64, 4096));
  add_mesh_frame(*command, options->frame);
  add_threads(*command, *options);
  command->footer(
      "Example:\n  dressform dress --garment runs/group1 runs/group3 --body runs/group2 scenes/library/group4.toml \\\n"
      "      -o wardrobe");
  return [options] { return dress_bodies(*options); };
}

const RegisteredCommand registered_dress{74, add_dress_command};

}  // namespace
}  // namespace dressform
