// Pictures of a grid's cells, from run folders as they lie on disk.
#include <fmt/format.h>

#include <map>
#include <opencv2/imgcodecs.hpp>

#include "eval/figures/grid_file.h"
#include "eval/report/error_images.h"
#include "eval/report/image_tools.h"
#include "eval/report/stage_images.h"
#include "eval/report/turned.h"
#include "eval/run/recorded_request.h"
#include "eval/score/metric.h"
#include "eval/score/scores.h"
#include "scenes/capture_session.h"
#include "scenes/ground_truth.h"
#include "scenes/image_file.h"
#include "scenes/json_file.h"
#include "scenes/mesh_io.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

constexpr double kRoomAroundClothes = 0.08;  // of their size

// What is read of a run, once for all its cells.
struct GridRun {
  fs::path folder, session;
  std::vector<std::string> sensors;
  std::map<std::string, Isometry3d> model_from_sensor;
  double user_heading = 0;

  explicit GridRun(const fs::path& run) : folder(run), session(recorded_request(run).session) {
    sensors = read_session_outline(session).sensors;
    const JsonValue poses = read_json(run / "out/registration.json");
    const JsonValue from_sensor = poses.at("model_from_sensor");
    for (const auto& sensor : from_sensor.names()) model_from_sensor[sensor] = from_sensor.at(sensor).rigid();
    if (poses.has("user_model_from_frame0")) {
      const Vector3d at = poses.at("user_model_from_frame0").rigid().translation();
      user_heading = std::atan2(at.x(), at.z());
    }
  }
  double heading() const {
    for (const auto& sensor : sensors)
      if (const auto pose = model_from_sensor.find(sensor); pose != model_from_sensor.end())
        return std::atan2(pose->second.translation().x(), pose->second.translation().z());
    return 0;
  }
  std::vector<std::string> slots(const GridChoice& cell) const {
    if (!cell.slot.empty()) return {cell.slot};
    return {"top", "bottom"};
  }
};

// The label image of a sensor's dressed shot, wherever the run's stages put it; empty where there is none.
cv::Mat labels_of(const GridRun& run, const std::string& sensor) {
  for (const auto& entry : fs::directory_iterator(run.folder / "stages")) {
    const std::string name = entry.path().filename().string();
    const fs::path file = entry.path() / (sensor + ".png");
    if (name.size() > 8 && name.compare(name.size() - 8, 8, "_segment") == 0 && fs::exists(file))
      return read_image(file, kIndexImage);
  }
  return {};
}

class GridMaker {
 public:
  explicit GridMaker(const GridFile& grid) : grid_(grid) {}

  GridFigure make() {
    GridFigure figure{grid_.title, grid_.caption, {}, {}, {}, grid_.zooms, {}};
    for (const auto& column : grid_.columns) figure.columns.push_back(column.label);
    for (const auto& row : grid_.rows) {
      figure.rows.push_back(row.label);
      figure.cells.emplace_back();
      for (const auto& column : grid_.columns) {
        const GridChoice cell = joined_choice(row, column);
        figure.cells.back().push_back(made_cell(cell));
        if (cell.show == "error") figure.scale = ColorScale{0, grid_.error_mm, "distance to truth", "mm"};
      }
    }
    return figure;
  }

 private:
  const GridRun& run_of(const fs::path& folder) {
    const auto found = runs_.find(folder);
    return found != runs_.end() ? found->second : runs_.emplace(folder, GridRun(folder)).first->second;
  }

  GridCell made_cell(const GridChoice& choice) {
    const GridRun& run = run_of(choice.run);
    GridCell cell;
    if (choice.show == "capture") cell.picture = captured(run, choice);
    if (choice.show == "mannequin") cell.picture = worn(run, choice, "naked_body.ply", ".glb", run.heading());
    if (choice.show == "user") cell.picture = worn(run, choice, "user_body.ply", "_fitted.glb", run.user_heading);
    if (choice.show == "error") cell.picture = errors(run, choice);
    if (choice.show == "image") cell.picture = read_image(run.folder / choice.file, kColorOrGreyImage);
    if (!choice.metric.empty()) cell.note = value_text(run, choice.metric);
    if (cell.picture.empty()) cell.note = "not made";
    return cell;
  }

  static std::string value_text(const GridRun& run, const std::string& metric) {
    const auto blank = metric.find(' ');
    const Scores scores = scores_from_json(run.folder / "scores.json");
    const ScoreRow* row =
        blank == std::string::npos ? nullptr : scores.find(metric.substr(0, blank), metric.substr(blank + 1));
    if (!row)
      throw InputError((run.folder / "scores.json").string(),
                       "has no row " + metric + "; expected a stage and a row, e.g. surface top/f_5mm@1");
    const std::string name = row->metric.substr(0, row->metric.find('@'));
    return name + " " + (row->status == "ok" ? number_text(row->value, row->unit) : row->status);
  }

  cv::Mat captured(const GridRun& run, const GridChoice& choice) {
    const std::string sensor = !choice.sensor.empty() ? choice.sensor : run.sensors.empty() ? "" : run.sensors.front();
    auto session = sessions_.find(run.session);
    if (session == sessions_.end()) session = sessions_.emplace(run.session, read_capture_session(run.session)).first;
    const auto shot = session->second.dressed.find(sensor);
    if (shot == session->second.dressed.end())
      throw InputError(run.session.string(), "has no dressed shot of sensor " + sensor);
    const cv::Mat labels = labels_of(run, sensor);
    if (labels.empty() || labels.size() != shot->second.color.size()) return shot->second.color;
    return shot->second.color(box_around(labels, kRoomAroundClothes)).clone();
  }

  // A body in the garments that the run made. Empty where it made none of them.
  cv::Mat worn(const GridRun& run, const GridChoice& choice, const std::string& body_file, const std::string& ending,
               double heading) {
    const fs::path out = run.folder / "out";
    if (!fs::exists(out / body_file)) return {};
    const Mesh body = turned(read_mesh(out / body_file), heading);
    std::vector<TexturedMesh> garments;
    for (const auto& slot : run.slots(choice))
      if (fs::exists(out / (slot + ending)))
        garments.push_back(turned(read_textured_mesh(out / (slot + ending)), heading));
    if (garments.empty()) return {};
    std::vector<RenderItem> items(1);
    items[0].mesh = &body;
    items[0].color = kBodyColor;
    for (const auto& garment : garments) {
      items.emplace_back();
      items.back().textured = &garment;
      items.back().shading = Shading::textured;
    }
    return rendered(items, choice.view_deg);
  }

  // Distances of the garments to the true ones, joined through the first sensor as the scorer does.
  cv::Mat errors(const GridRun& run, const GridChoice& choice) {
    if (!ground_truth_exists(run.session) || run.sensors.empty()) return {};
    const GroundTruth truth = read_ground_truth(run.session);
    const auto pose = run.model_from_sensor.find(run.sensors.front());
    const auto true_pose = truth.world_from_sensor.find(run.sensors.front());
    if (pose == run.model_from_sensor.end() || true_pose == truth.world_from_sensor.end()) return {};
    const Isometry3d world_from_model = true_pose->second * pose->second.inverse();
    std::vector<Mesh> meshes;
    std::vector<std::vector<double>> distances;
    for (const auto& slot : run.slots(choice)) {
      const auto real = truth.garments.find(slot);
      const fs::path file = run.folder / "out" / (slot + ".ply");
      if (real == truth.garments.end() || !fs::exists(file)) continue;
      const Mesh mesh = read_mesh(file);
      distances.push_back(vertex_distances_mm(transformed(mesh, world_from_model.matrix()), real->second.mesh));
      meshes.push_back(turned(mesh, run.heading()));
    }
    std::vector<RenderItem> items(meshes.size());
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      items[i].mesh = &meshes[i];
      items[i].shading = Shading::scalar;
      items[i].scalars = distances[i];
      items[i].scalar_maximum = grid_.error_mm;
    }
    return items.empty() ? cv::Mat() : rendered(items, choice.view_deg);
  }

  cv::Mat rendered(const std::vector<RenderItem>& items, double view_deg) {
    Eigen::AlignedBox3d box;
    for (const auto& item : items)
      for (const auto& vertex : item.textured ? item.textured->mesh.vertices : item.mesh->vertices) box.extend(vertex);
    const double part = std::clamp(std::hypot(box.sizes().x(), box.sizes().z()) / box.sizes().y(), 0.4, 1.6);
    const int width = static_cast<int>(part * grid_.height_px);
    return renderer_.render(look_at_box(box.min(), box.max(), view_deg, 0, width, grid_.height_px), items);
  }

  const GridFile& grid_;
  Renderer renderer_;
  std::map<fs::path, GridRun> runs_;
  std::map<fs::path, CaptureSession> sessions_;
};

}  // namespace

GridFigure grid_figure(const GridFile& grid) { return GridMaker(grid).make(); }

}  // namespace dressform
