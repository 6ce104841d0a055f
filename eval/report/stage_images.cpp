#include "eval/report/stage_images.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "eval/report/rim_marks.h"
#include "eval/report/turned.h"

namespace dressform {
namespace {

constexpr int kHeight = 420;
const cv::Scalar kSkinColor(150, 190, 235), kTopColor(200, 120, 40), kBottomColor(60, 160, 60);
const Eigen::Vector3f kGarmentColor(0.55f, 0.66f, 0.82f);
const Eigen::Vector3f kSeenRim(0.10f, 0.30f, 0.65f), kUnseenRim(0.95f, 0.50f, 0.05f);

// Distinct colours for the views, RGB.
Eigen::Vector3f view_color(int view) {
  static const Eigen::Vector3f colors[] = {{0.85f, 0.25f, 0.20f}, {0.20f, 0.55f, 0.85f}, {0.25f, 0.70f, 0.30f},
                                           {0.90f, 0.65f, 0.10f}, {0.60f, 0.30f, 0.75f}, {0.20f, 0.70f, 0.70f}};
  return colors[view % 6];
}

// One image a sensor, side by side.
template <class Paint>
cv::Mat per_view(const Reconstruction& reconstruction, const Paint& paint) {
  std::vector<cv::Mat> images;
  for (const auto& sensor : reconstruction.sensors) {
    const cv::Mat image = paint(sensor);
    if (!image.empty()) images.push_back(image);
  }
  return side_by_side(images, kHeight);
}

void add(std::vector<Figure>& figures, const std::string& name, const std::string& title, const std::string& caption,
         const cv::Mat& image) {
  if (!image.empty()) figures.push_back({name, title, caption, image});
}

cv::Mat color_of(const std::map<std::string, Shot>& shots, const std::string& sensor) {
  const auto found = shots.find(sensor);
  return found == shots.end() ? cv::Mat() : found->second.color;
}

// The sensors that a picture shows nothing of, as the end of its caption.
std::string without(const Reconstruction& reconstruction, const std::string& why,
                    const std::function<bool(const std::string& sensor)>& shown) {
  std::string names;
  for (const auto& sensor : reconstruction.sensors)
    if (!shown(sensor)) names += (names.empty() ? "" : ", ") + sensor;
  return names.empty() ? "" : " " + why + ": " + names + ".";
}

std::vector<Figure> capture_figures(const Reconstruction& reconstruction, const CaptureSession& session) {
  std::vector<Figure> figures;
  for (const auto& [name, shots] : {std::pair("naked", &session.naked), std::pair("dressed", &session.dressed)}) {
    add(figures, std::string("capture_") + name + "_color", std::string(name) + ", colour",
        "As captured, one sensor a column.",
        per_view(reconstruction, [&](const auto& sensor) { return color_of(*shots, sensor); }));
    add(figures, std::string("capture_") + name + "_depth", std::string(name) + ", depth",
        "Depth along the axis from 1.2 m (red) to 4.5 m (blue); black: no measurement.",
        per_view(reconstruction, [&](const auto& sensor) {
          const auto found = shots->find(sensor);
          return found == shots->end() ? cv::Mat() : depth_image(found->second.depth_mm, 1.2, 4.5);
        }));
  }
  return figures;
}

std::vector<Figure> body_figures(const BodyModel& model, double heading, const std::string& name, Renderer& renderer) {
  const Mesh body = turned(model.body, heading);
  PointCloud path;
  for (const auto& pose : model.model_from_frame) path.points.push_back(turned(pose.translation(), heading));
  RenderItem item, dots;
  item.mesh = &body;
  item.color = kBodyColor;
  dots.points = &path;
  dots.shading = Shading::points;
  dots.color = view_color(0);
  std::vector<Figure> figures;
  if (body.triangles.empty()) return {};
  add(figures, name + "_body", "body model", "Mesh from the scan: front, left, back, right.",
      four_views(renderer, {item}, kHeight));
  if (!path.points.empty()) {
    const Vector3d reach(2.4, 2.2, 2.4);
    const auto view = look_at_box(Vector3d(-reach.x(), 0, -reach.z()), reach, 20, 35, 900, kHeight);
    add(figures, name + "_path", "path of the scanner", "Estimated sensor positions round the body.",
        renderer.render(view, {item, dots}));
  }
  return figures;
}

std::vector<Figure> extract_figures(const Reconstruction& reconstruction, const CaptureSession& session) {
  const auto& views = reconstruction.extracted.get().views;
  const std::string missing = without(reconstruction, "Not found in", [&](const auto& sensor) {
    return views.count(sensor) && views.at(sensor).found_dressed;
  });
  std::vector<Figure> figures;
  add(figures, "extract_dressed", "dressed mannequin", "The mask of the dressed mannequin, tinted." + missing,
      per_view(reconstruction, [&](const auto& sensor) {
        const auto found = views.find(sensor);
        const cv::Mat color = color_of(session.dressed, sensor);
        return found == views.end() || color.empty() ? cv::Mat()
                                                     : tinted(color, found->second.dressed_color, {40, 200, 40});
      }));
  return figures;
}

// Points of the naked views in the model frame, each view in its own colour.
PointCloud registered_points(const Reconstruction& reconstruction, const CaptureSession& session, double heading) {
  PointCloud cloud;
  int number = 0;
  for (const auto& sensor : reconstruction.sensors) {
    const int view = number++;
    const auto& registration = reconstruction.registration.get();
    const auto pose = registration.model_from_sensor.find(sensor);
    const auto masks = reconstruction.extracted.get().views.find(sensor);
    if (pose == registration.model_from_sensor.end() || masks == reconstruction.extracted.get().views.end()) continue;
    const auto& calibration = reconstruction.calibration.get().sensors.at(sensor);
    const cv::Mat& depth = session.naked.at(sensor).depth_mm;
    for (int v = 0; v < depth.rows; v += 2)
      for (int u = 0; u < depth.cols; u += 2) {
        const double z = depth.at<unsigned short>(v, u) * 0.001 - calibration.depth_offset_m;
        if (z <= 0 || !masks->second.naked.at<unsigned char>(v, u)) continue;
        cloud.points.push_back(turned(pose->second * calibration.ir.unproject({u, v}, z), heading));
        cloud.colors.push_back(view_color(view));
      }
  }
  return cloud;
}

std::vector<Figure> registration_figures(const Reconstruction& reconstruction, const CaptureSession& session,
                                         double heading, Renderer& renderer) {
  const PointCloud cloud = registered_points(reconstruction, session, heading);
  const Mesh body = turned(reconstruction.naked.get().body, heading);
  std::vector<Figure> figures;
  if (cloud.points.empty()) return figures;
  RenderItem points, mesh;
  points.points = &cloud;
  points.shading = Shading::points;
  mesh.mesh = &body;
  mesh.color = kBodyColor;
  const auto& poses = reconstruction.registration.get().model_from_sensor;
  const std::string missing =
      without(reconstruction, "Not registered", [&](const auto& sensor) { return poses.count(sensor) > 0; });
  add(figures, "registration_points", "registered views",
      "The naked views in the model frame, one colour a sensor." + missing, four_views(renderer, {points}, kHeight));
  add(figures, "registration_on_model", "on the model", "The same points on the scanned model.",
      four_views(renderer, {points, mesh}, kHeight));
  return figures;
}

// Names the labels that are there.
std::string labels_caption(const std::map<std::string, cv::Mat>& labels) {
  std::string text;
  for (const auto& [name, label] : {std::pair("skin (beige)", Label::skin), std::pair("top (blue)", Label::top),
                                    std::pair("bottom (green)", Label::bottom)})
    if (std::any_of(labels.begin(), labels.end(), [wanted = static_cast<int>(label)](const auto& each) {
          return cv::countNonZero(each.second == wanted) > 0;
        }))
      text += (text.empty() ? "" : ", ") + std::string(name);
  if (text.empty()) return "Neither skin nor clothes were found on the dressed views.";
  return "On the dressed views, cropped: " + text + ".";
}

std::vector<Figure> segment_figures(const Reconstruction& reconstruction, const CaptureSession& session) {
  const auto& labels = reconstruction.segmentation.get().labels;
  std::vector<Figure> figures;
  add(figures, "segment_labels", "labels", labels_caption(labels), per_view(reconstruction, [&](const auto& sensor) {
        const auto found = labels.find(sensor);
        cv::Mat image = color_of(session.dressed, sensor);
        if (found == labels.end() || image.empty()) return cv::Mat();
        const cv::Mat& label = found->second;
        image = tinted(image, label == static_cast<int>(Label::skin), kSkinColor);
        image = tinted(image, label == static_cast<int>(Label::top), kTopColor);
        image = tinted(image, label == static_cast<int>(Label::bottom), kBottomColor);
        return cv::Mat(image(box_around(label, 0.05)));
      }));
  return figures;
}

std::vector<Figure> fill_figures(const Reconstruction& reconstruction) {
  std::vector<Figure> figures;
  for (const auto& [slot, views] : reconstruction.filled.get().garments)
    add(figures, "fill_" + slot, slot + ", filled",
        "The garment cut out of each view; filled-in parts have a magenta edge.",
        per_view(reconstruction, [&, &views = views](const auto& sensor) {
          const auto found = views.find(sensor);
          if (found == views.end() || found->second.color.empty()) return cv::Mat();
          cv::Mat image(found->second.color.size(), CV_8UC3, cv::Scalar::all(255)), edge;
          found->second.color.copyTo(image, found->second.mask);
          const cv::Mat filled = found->second.mask == 128;
          cv::morphologyEx(filled, edge, cv::MORPH_GRADIENT, cv::Mat::ones(3, 3, CV_8U));
          image.setTo(cv::Scalar(255, 0, 255), edge);
          return cv::Mat(image(box_around(found->second.mask, 0.08)));
        }));
  return figures;
}

// One four-view image for each garment.
template <class Garments, class Mesher>
std::vector<Figure> garment_figures(const Garments& garments, double heading, const std::string& name,
                                    const std::string& caption, Renderer& renderer, const Mesher& mesh_of) {
  std::vector<Figure> figures;
  for (const auto& [slot, garment] : garments) {
    const Mesh mesh = turned(mesh_of(garment), heading);
    RenderItem item;
    item.mesh = &mesh;
    item.color = kGarmentColor;
    add(figures, name + "_" + slot, slot, caption, four_views(renderer, {item}, kHeight));
  }
  return figures;
}

// The opened garments, their rims marked.
std::vector<Figure> open_figures(const OpenGarments& opened, double heading, Renderer& renderer) {
  std::vector<Figure> figures;
  for (const auto& [slot, garment] : opened.garments) {
    const RimMarks marks = rim_marks(garment);
    const Mesh meshes[] = {turned(garment.mesh, heading), turned(marks.seen, heading), turned(marks.unseen, heading)};
    const Eigen::Vector3f colors[] = {kGarmentColor, kSeenRim, kUnseenRim};
    std::vector<RenderItem> items;
    for (int i = 0; i < 3; ++i) {
      if (meshes[i].triangles.empty()) continue;
      items.emplace_back();
      items.back().mesh = &meshes[i];
      items.back().color = colors[i];
    }
    std::string caption = "Opened at its rims (blue); the inside is drawn darker.";
    if (!marks.unseen.triangles.empty()) caption += " No view saw the orange ones: carried on from what was seen.";
    add(figures, "open_" + slot, slot, caption, four_views(renderer, items, kHeight));
  }
  return figures;
}

std::vector<Figure> texture_figures(const Reconstruction& reconstruction, double heading, Renderer& renderer) {
  std::vector<Figure> figures;
  for (const auto& [slot, garment] : reconstruction.textured.get().garments) {
    const TexturedMesh mesh = turned(garment, heading);
    RenderItem item;
    item.textured = &mesh;
    item.shading = Shading::textured;
    add(figures, "texture_" + slot, slot + ", textured", "Front, left, back, right.",
        four_views(renderer, {item}, kHeight));
    add(figures, "texture_" + slot + "_atlas", slot + ", texture map", "The atlas that the views were projected into.",
        side_by_side({garment.texture}, kHeight));
  }
  return figures;
}

}  // namespace

std::vector<StageFigures> stage_figures(const Reconstruction& reconstruction, const CaptureSession& session,
                                        Renderer& renderer) {
  const double heading = front_heading(reconstruction);
  std::vector<StageFigures> stages;
  stages.push_back({"capture", capture_figures(reconstruction, session)});
  stages.push_back({"fuse_naked", body_figures(reconstruction.naked.get(), heading, "fuse_naked", renderer)});
  stages.push_back({"extract", extract_figures(reconstruction, session)});
  stages.push_back({"registration", registration_figures(reconstruction, session, heading, renderer)});
  stages.push_back({"landmarks_naked", {}});
  stages.push_back({"segment", segment_figures(reconstruction, session)});
  stages.push_back({"fill", fill_figures(reconstruction)});
  const auto mesh_of = [](const auto& garment) -> const Mesh& { return garment.mesh; };
  stages.push_back({"surface", garment_figures(reconstruction.closed.get().garments, heading, "surface",
                                               "Closed surface.", renderer, mesh_of)});
  stages.push_back({"open", open_figures(reconstruction.opened.get(), heading, renderer)});
  stages.push_back({"texture", texture_figures(reconstruction, heading, renderer)});
  if (reconstruction.user) {
    const double user_heading = scan_heading(reconstruction.user->get());
    stages.push_back({"fuse_user", body_figures(reconstruction.user->get(), user_heading, "fuse_user", renderer)});
    stages.push_back({"fit", garment_figures(reconstruction.fitted->get().garments, user_heading, "fit",
                                             "Moved to the user, before correction.", renderer, mesh_of)});
    stages.push_back({"correct", garment_figures(reconstruction.corrected->get().garments, user_heading, "correct",
                                                 "After correction.", renderer, mesh_of)});
  }
  return stages;
}

}  // namespace dressform
