// A small pipeline of someone else's: open3d_pipeline SESSION OUT [VOXEL_M].
// The dressed depth images of a session as clouds, brought together by ICP from the rig's prior, one Poisson surface of
// the whole person, cut by height into what is worn above and below. It knows neither bodies nor clothes: a baseline
// that anything should beat, and an example of what a command in a study reads and leaves (eval/studies/README.md).
#include <open3d/geometry/Image.h>
#include <open3d/geometry/PointCloud.h>
#include <open3d/geometry/TriangleMesh.h>
#include <open3d/io/ImageIO.h>
#include <open3d/io/TriangleMeshIO.h>
#include <open3d/pipelines/registration/Registration.h>
#include <open3d/pipelines/registration/RobustKernel.h>
#include <open3d/pipelines/registration/TransformationEstimation.h>
#include <open3d/utility/Logging.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace fs = std::filesystem;
using nlohmann::json;
using open3d::geometry::Image;
using open3d::geometry::PointCloud;
using open3d::geometry::TriangleMesh;

namespace {

constexpr double kAlignRadius_m = 1.0;  // about the world's axis: person and floor, by which views are aligned
constexpr double kFarthestTurn_deg =
    20;  // three times what a prior of a rig is usually wrong by, one sensor against another
constexpr double kFarthestStep_m = 0.5;   // likewise, at the person
constexpr double kPersonRadius_m = 0.65;  // the person alone, arms away from the body
constexpr double kFloor_m = 0.03;         // below is floor
constexpr double kSplit = 0.54;           // of the person's height, between what is worn above and below: the waist
constexpr double kTop = 0.82;             // the neck
constexpr double kTrim = 0.05;            // share of the surface that the fewest points speak for: left out
constexpr int kOctreeDepth = 8;

json read_json(const fs::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + ": cannot be read");
  return json::parse(in);
}

Eigen::Matrix4d matrix_of(const json& rows) {
  Eigen::Matrix4d matrix;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) matrix(r, c) = rows.at(r).at(c);
  return matrix;
}

Image read_image(const fs::path& folder, const std::string& name) {
  for (const char* ending : {".png", ".jpg"}) {
    Image image;
    const fs::path file = folder / (name + ending);
    if (fs::exists(file) && open3d::io::ReadImage(file.string(), image)) return image;
  }
  throw std::runtime_error((folder / name).string() + ": no such image");
}

// One sensor's points with colours, in its infrared camera's frame; lenses are taken for pinholes.
std::shared_ptr<PointCloud> cloud_of(const fs::path& shot, const json& sensor) {
  const Image depth = read_image(shot, "depth");
  const json& ir = sensor.at("ir");
  const double offset_m = sensor.value("depth_offset_m", 0.0);
  Image color;
  Eigen::Matrix4d color_from_ir = Eigen::Matrix4d::Identity();
  const bool colored = sensor.contains("color");
  if (colored) {
    color = read_image(shot, "color");
    color_from_ir = matrix_of(sensor.at("color_from_ir"));
  }
  auto cloud = std::make_shared<PointCloud>();
  for (int y = 0; y < depth.height_; ++y)
    for (int x = 0; x < depth.width_; ++x) {
      const double z = *depth.PointerAt<std::uint16_t>(x, y) / 1000.0 - offset_m;
      if (z < 0.3) continue;
      const Eigen::Vector4d point((x - ir.at("cx").get<double>()) / ir.at("fx").get<double>() * z,
                                  (y - ir.at("cy").get<double>()) / ir.at("fy").get<double>() * z, z, 1);
      Eigen::Vector3d rgb(0.5, 0.5, 0.5);
      if (colored) {
        const Eigen::Vector4d seen = color_from_ir * point;
        const json& camera = sensor.at("color");
        const int u = static_cast<int>(
            std::lround(seen.x() / seen.z() * camera.at("fx").get<double>() + camera.at("cx").get<double>()));
        const int v = static_cast<int>(
            std::lround(seen.y() / seen.z() * camera.at("fy").get<double>() + camera.at("cy").get<double>()));
        if (u >= 0 && v >= 0 && u < color.width_ && v < color.height_)
          for (int k = 0; k < 3; ++k) rgb[k] = *color.PointerAt<std::uint8_t>(u, v, k) / 255.0;
      }
      cloud->points_.push_back(point.head<3>());
      cloud->colors_.push_back(rgb);
    }
  return cloud;
}

// What lies within a radius of the world's upright axis, from a height on.
std::shared_ptr<PointCloud> within(const PointCloud& cloud, double radius_m, double from_y) {
  std::vector<size_t> kept;
  for (size_t i = 0; i < cloud.points_.size(); ++i) {
    const auto& p = cloud.points_[i];
    if (std::hypot(p.x(), p.z()) < radius_m && p.y() > from_y && p.y() < 2.3) kept.push_back(i);
  }
  return cloud.SelectByIndex(kept);
}

// Moves `cloud`, which the prior has put roughly in place, onto `target`: point-to-plane ICP from coarse to fine. What
// it moves farther than the prior can be wrong it has moved to the wrong place: then the prior stays.
Eigen::Matrix4d aligned(const PointCloud& cloud, const PointCloud& target, double voxel_m) {
  namespace registration = open3d::pipelines::registration;
  Eigen::Matrix4d motion = Eigen::Matrix4d::Identity();
  for (const double reach_m : {0.4, 0.15, 4 * voxel_m})
    motion = registration::RegistrationICP(
                 cloud, target, reach_m, motion,
                 registration::TransformationEstimationPointToPlane(std::make_shared<registration::TukeyLoss>(reach_m)))
                 .transformation_;
  const double turn_deg = Eigen::AngleAxisd(Eigen::Matrix3d(motion.block<3, 3>(0, 0))).angle() * 180 / M_PI;
  const Eigen::Vector3d middle(0, 1, 0);
  const double step_m = (motion.block<3, 3>(0, 0) * middle + motion.block<3, 1>(0, 3) - middle).norm();
  const bool likely = turn_deg < kFarthestTurn_deg && step_m < kFarthestStep_m;
  return likely ? motion : Eigen::Matrix4d(Eigen::Matrix4d::Identity());
}

// The surface's part between two heights, its largest piece.
std::shared_ptr<TriangleMesh> part_of(const TriangleMesh& surface, double from_y, double to_y) {
  auto part = std::make_shared<TriangleMesh>(surface);
  std::vector<bool> outside(part->vertices_.size());
  for (size_t i = 0; i < outside.size(); ++i) {
    const double y = part->vertices_[i].y();
    outside[i] = y < from_y || y > to_y;
  }
  part->RemoveVerticesByMask(outside);
  const auto [cluster_of, sizes, areas] = part->ClusterConnectedTriangles();
  if (sizes.empty()) return part;
  const int largest = static_cast<int>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  std::vector<bool> others(cluster_of.size());
  for (size_t i = 0; i < others.size(); ++i) others[i] = cluster_of[i] != largest;
  part->RemoveTrianglesByMask(others);
  part->RemoveUnreferencedVertices();
  return part;
}

std::shared_ptr<TriangleMesh> surface_of(const PointCloud& person) {
  auto [surface, support] = TriangleMesh::CreateFromPointCloudPoisson(person, kOctreeDepth, 0, 1.1, false, 1);
  std::vector<double> sorted = support;
  std::sort(sorted.begin(), sorted.end());
  std::vector<bool> weak(support.size());
  for (size_t i = 0; i < support.size(); ++i) weak[i] = support[i] < sorted[static_cast<size_t>(kTrim * sorted.size())];
  surface->RemoveVerticesByMask(weak);
  return surface;
}

void write_registration(const fs::path& file, const std::map<std::string, Eigen::Matrix4d>& poses) {
  json text = {{"model_from_sensor", json::object()}, {"converged", json::object()}};
  for (const auto& [sensor, pose] : poses) {
    json rows = json::array();
    for (int r = 0; r < 4; ++r) rows.push_back({pose(r, 0), pose(r, 1), pose(r, 2), pose(r, 3)});
    text["model_from_sensor"][sensor] = rows;
    text["converged"][sensor] = true;
  }
  std::ofstream(file) << text.dump(1) << "\n";
}

// Sensors in an order in which each looks much the same way as one before it: what faces another has little in common
// with it until the sides are there.
std::vector<std::string> neighbours_first(const json& sensors, const json& prior) {
  std::vector<std::string> left = sensors, order{left.front()};
  left.erase(left.begin());
  const auto view = [&](const std::string& sensor) -> Eigen::Vector3d {
    return matrix_of(prior.at(sensor)).block<3, 1>(0, 2);
  };
  while (!left.empty()) {
    auto next = left.begin();
    double nearest = -2;
    for (auto each = left.begin(); each != left.end(); ++each)
      for (const auto& before : order)
        if (const double cosine = view(*each).dot(view(before)); cosine > nearest + 1e-9) nearest = cosine, next = each;
    order.push_back(*next);
    left.erase(next);
  }
  return order;
}

void run(const fs::path& session, const fs::path& out, double voxel_m) {
  const json index = read_json(session / "session.json"),
             sensors = read_json(session / "calibration.json").at("sensors");
  if (!index.contains("world_from_sensor_prior"))
    throw std::runtime_error("session.json: no prior of the rig to start from");
  std::map<std::string, Eigen::Matrix4d> poses;
  PointCloud all;
  for (const std::string& sensor :
       neighbours_first(index.at("shots").at("dressed"), index.at("world_from_sensor_prior"))) {
    auto cloud = cloud_of(session / "dressed" / sensor, sensors.at(sensor));
    Eigen::Matrix4d pose = matrix_of(index.at("world_from_sensor_prior").at(sensor));
    cloud = within(cloud->Transform(pose), kAlignRadius_m, -0.2)->VoxelDownSample(voxel_m);
    cloud->EstimateNormals();
    cloud->OrientNormalsTowardsCameraLocation(pose.block<3, 1>(0, 3));
    if (!all.IsEmpty()) {
      const Eigen::Matrix4d motion = aligned(*cloud, all, voxel_m);
      cloud->Transform(motion);
      pose = motion * pose;
    }
    all += *cloud;
    poses[sensor] = pose;
  }
  const auto person = within(all, kPersonRadius_m, kFloor_m);
  if (person->points_.size() < 100)
    throw std::runtime_error("fewer than 100 points of a person: nothing to make a surface of");
  const auto surface = surface_of(*person);
  const double height = person->GetMaxBound().y();
  fs::create_directories(out);
  open3d::io::WriteTriangleMesh((out / "top.ply").string(), *part_of(*surface, kSplit * height, kTop * height));
  open3d::io::WriteTriangleMesh((out / "bottom.ply").string(), *part_of(*surface, kFloor_m, kSplit * height));
  write_registration(out / "registration.json", poses);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || argc > 4) {
    std::fprintf(stderr, "usage: open3d_pipeline SESSION OUT [VOXEL_M]\n");
    return 2;
  }
  open3d::utility::SetVerbosityLevel(open3d::utility::VerbosityLevel::Error);
  try {
    run(argv[1], argv[2], argc == 4 ? std::stod(argv[3]) : 0.005);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}
