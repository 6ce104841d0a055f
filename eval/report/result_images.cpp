#include <cctype>

#include "eval/report/rim_marks.h"
#include "eval/report/stage_images.h"
#include "eval/report/turned.h"

namespace dressform {
namespace {

using Garments = std::map<std::string, TexturedMesh>;

// "Reconstructed bottom and top on the mannequin"; where nothing was made, that.
std::string result_title(const Garments& garments, const std::string& done, const std::string& wearer) {
  if (garments.empty()) return "The " + wearer + " alone: no clothes were " + done;
  std::string names;
  for (const auto& [slot, garment] : garments) names += (names.empty() ? "" : " and ") + slot;
  return static_cast<char>(std::toupper(done[0])) + done.substr(1) + " " + names + " on the " + wearer;
}

void add_dressed(std::vector<Figure>& figures, const Mesh& body, const Garments& garments, double heading,
                 const std::string& name, const std::string& title, const std::string& note, bool turntable,
                 Renderer& renderer) {
  const Mesh body_mesh = turned(body, heading);
  std::vector<TexturedMesh> meshes;
  for (const auto& [slot, garment] : garments) meshes.push_back(turned(garment, heading));
  std::vector<RenderItem> items(1 + meshes.size());
  items[0].mesh = &body_mesh;
  items[0].color = kBodyColor;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    items[i + 1].textured = &meshes[i];
    items[i + 1].shading = Shading::textured;
  }
  figures.push_back({name, title, "Front, left, back, right." + note, four_views(renderer, items, 640)});
  if (turntable)
    figures.push_back({name + "_turntable", title + ", turntable", "Twelve views round the vertical axis.",
                       contact_sheet(renderer, items, 12, 6, 380)});
}

}  // namespace

std::vector<Figure> result_figures(const Reconstruction& reconstruction, Renderer& renderer, bool turntables) {
  std::vector<Figure> figures;
  const Garments& made = reconstruction.textured.get().garments;
  const std::string unseen = unseen_rims_caption(reconstruction.opened.get());
  const std::string note = unseen.empty() ? "" : " " + unseen;
  add_dressed(figures, reconstruction.naked.get().body, made, front_heading(reconstruction), "result_mannequin",
              result_title(made, "reconstructed", "mannequin"), note, turntables, renderer);
  if (!reconstruction.corrected) return figures;
  const Garments& fitted = reconstruction.corrected->get().garments;
  add_dressed(figures, reconstruction.user->get().body, fitted, scan_heading(reconstruction.user->get()), "result_user",
              result_title(fitted, "fitted", "user"), note, turntables, renderer);
  return figures;
}

}  // namespace dressform
