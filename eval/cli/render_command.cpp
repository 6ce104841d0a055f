#include <fmt/format.h>

#include <memory>
#include <opencv2/imgcodecs.hpp>

#include "eval/cli/commands.h"
#include "eval/cli/options.h"
#include "eval/report/compared_meshes.h"
#include "render/turntable.h"
#include "scenes/file_bytes.h"
#include "scenes/mesh_io.h"

namespace dressform {
namespace {

struct RenderOptionsCli {
  std::vector<std::filesystem::path> meshes;
  std::filesystem::path output;
  bool turntable = false, compare = false;
  TurntableOptions turn;
  std::string shading = "auto", layout = "four";
  int height = 720;
  MeshFrame frame;
};

const std::map<std::string, Shading> kShadings = {{"textured", Shading::textured},
                                                  {"unlit", Shading::unlit},
                                                  {"shaded", Shading::shaded},
                                                  {"normals", Shading::normals},
                                                  {"wireframe", Shading::wireframe}};

bool wants_texture(const std::string& shading) { return shading == "textured" || shading == "unlit"; }

// Meshes that the items of an image point into.
struct LoadedMeshes {
  std::vector<std::unique_ptr<TexturedMesh>> meshes;
  std::vector<RenderItem> items;

  void load(const std::filesystem::path& file, const std::string& shading, const MeshFrame& frame) {
    RenderItem item;
    auto mesh = std::make_unique<TexturedMesh>();
    if (shading == "auto")
      *mesh = read_mesh_as_it_looks(file);
    else if (wants_texture(shading))
      *mesh = read_textured_mesh(file);
    else
      mesh->mesh = read_mesh(file);
    mesh->mesh = in_world(std::move(mesh->mesh), frame);
    const bool has_texture = !mesh->texture.empty();
    if (has_texture)
      item.textured = mesh.get();
    else
      item.mesh = &mesh->mesh;
    item.shading = shading != "auto" ? kShadings.at(shading) : has_texture ? Shading::textured : Shading::shaded;
    meshes.push_back(std::move(mesh));
    items.push_back(item);
  }
};

int write_image(const cv::Mat& image, const std::filesystem::path& file) {
  std::vector<unsigned char> bytes;
  cv::imencode(".png", image, bytes);
  write_file_atomically(file, std::string(bytes.begin(), bytes.end()));
  fmt::print("{} ({} x {})\n", file.string(), image.cols, image.rows);
  return kSuccess;
}

int write_turntable(Renderer& renderer, const LoadedMeshes& loaded, const RenderOptionsCli& options) {
  TurntableOptions turn = options.turn;
  turn.height_px = options.height;
  const std::string ending = options.output.extension().string();
  const auto frames = turntable_frames(renderer, loaded.items, turn);
  const auto written = write_animation(frames, turn.frames_per_second, options.output);
  if ((ending == ".webp" || ending == ".mp4") && written != options.output)
    fmt::print("no ffmpeg here (Debian: ffmpeg): frames instead of an animation\n");
  fmt::print("{} ({} frames of {} x {})\n", written.string(), frames.size(), frames[0].cols, frames[0].rows);
  return kSuccess;
}

int render_meshes(const RenderOptionsCli& options) {
  if (options.compare && options.meshes.size() != 2)
    throw InputError("--compare", fmt::format("found {} meshes; expected two", options.meshes.size()));
  if (options.compare && options.turntable)
    throw InputError("--compare", "found it beside --turntable; expected one of the two");
  LoadedMeshes loaded;
  for (const auto& file : options.meshes) loaded.load(file, options.shading, options.frame);
  Renderer renderer;
  if (options.turntable) return write_turntable(renderer, loaded, options);
  if (options.compare)
    return write_image(
        compared_meshes(renderer, loaded.items[0], loaded.items[1],
                        {options.meshes[0].filename().string(), options.meshes[1].filename().string()}, options.height),
        options.output);
  return write_image(options.layout == "four" ? four_views(renderer, loaded.items, options.height)
                                              : contact_sheet(renderer, loaded.items, 12, 6, options.height),
                     options.output);
}

Command add_render_command(CLI::App& app) {
  auto options = std::make_shared<RenderOptionsCli>();
  auto* command = app.add_subcommand("render", "Images of meshes (OBJ, PLY, GLB), off screen");
  command->add_option("meshes", options->meshes, "mesh files, drawn together")->required();
  command
      ->add_option("-o,--output", options->output,
                   "PNG to write; with --turntable a .webp or .mp4, or a new folder for frames")
      ->required();
  command->add_flag("--turntable", options->turntable, "an animation that goes round (ffmpeg; else its frames)");
  command->add_option("--frames", options->turn.frames, "of a turn (default 48)")->check(CLI::Range(2, 720));
  command->add_flag("--compare", options->compare,
                    "two meshes from the same sides, and how far the first is from the second, in mm");
  command->add_option("--shading", options->shading, "auto: textured where there is a texture, else shaded")
      ->check(CLI::IsMember({"auto", "textured", "unlit", "shaded", "normals", "wireframe"}));
  command->add_option("--layout", options->layout, "four views side by side, or a turntable of twelve")
      ->check(CLI::IsMember({"four", "turntable"}));
  command->add_option("--height", options->height, "pixels of one view (default 720)")->check(CLI::Range(64, 4096));
  add_mesh_frame(*command, options->frame);
  command->footer(
      "Examples:\n  dressform render runs/group1/out/naked_body.ply runs/group1/out/top.glb -o top.png\n"
      "  dressform render runs/group1/out/user_body.ply runs/group1/out/top_fitted.glb --turntable -o top.webp\n"
      "  dressform render --compare a/out/top.glb b/out/top.glb -o difference.png");
  return [options] { return render_meshes(*options); };
}

const RegisteredCommand registered_render{70, add_render_command};

}  // namespace
}  // namespace dressform
