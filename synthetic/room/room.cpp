#include "synthetic/room/room.h"

#include <algorithm>
#include <cmath>

#include "scenes/random.h"
#include "synthetic/capture/shapes.h"
#include "synthetic/capture/texture_pyramid.h"
#include "synthetic/room/room_images.h"

namespace dressform {
namespace {

constexpr double grid_step_m = 0.08;  // fine enough for the contact shadow of the indirect light

RaySurface plain(const char* name, Mesh mesh, const Vector3f& srgb, float nir_albedo) {
  RaySurface surface;
  surface.name = name;
  surface.mesh = std::move(mesh);
  surface.smooth = false;
  for (int c = 0; c < 3; ++c) surface.material.albedo_rgb[c] = linear_from_srgb(srgb[c]);
  surface.material.nir_albedo = nir_albedo;
  return surface;
}

RaySurface imaged(const char* name, const Vector3d& corner, const Vector3d& u, const Vector3d& v, cv::Mat texture,
                  float nir_albedo) {
  RaySurface surface = plain(name, grid_mesh(corner, u, v, grid_step_m), Vector3f::Ones(), nir_albedo);
  surface.corner_uv = grid_uv(surface.mesh, corner, u, v);
  surface.texture = std::move(texture);
  return surface;
}

void append(Mesh& mesh, const Mesh& more) {
  const int offset = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
  for (const auto& triangle : more.triangles) mesh.triangles.push_back(triangle.array() + offset);
}

RaySurface boxes(const char* name, const std::vector<std::array<Vector3d, 2>>& corners, const Vector3f& srgb,
                 float nir_albedo) {
  Mesh mesh;
  for (const auto& box : corners) append(mesh, box_mesh(box[0], box[1]));
  return plain(name, std::move(mesh), srgb, nir_albedo);
}

struct Half {
  double x, z, height;
};

void add_shell(const Half& half, std::vector<RaySurface>& out) {
  const double x = half.x, z = half.z, h = half.height;
  const Vector3d up(0, h, 0);
  // Texture rows run downwards: v from the top edge.
  out.push_back(imaged("floor", {-x, 0, z}, {2 * x, 0, 0}, {0, 0, -2 * z}, paint_floor(2 * x, 2 * z), 0.5f));
  out.push_back(
      plain("ceiling", grid_mesh({-x, h, -z}, {2 * x, 0, 0}, {0, 0, 2 * z}, 0.25), {0.93f, 0.93f, 0.91f}, 0.7f));
  const cv::Mat wall = paint_wall(2 * x, h, 1), side = paint_wall(2 * z, h, 2);
  out.push_back(imaged("wall -z", {-x, 0, -z}, {2 * x, 0, 0}, up, wall, 0.6f));
  out.push_back(imaged("wall +z", {x, 0, z}, {-2 * x, 0, 0}, up, wall, 0.6f));
  out.push_back(imaged("wall +x", {x, 0, -z}, {0, 0, 2 * z}, up, side, 0.6f));
  out.push_back(imaged("wall -x", {-x, 0, z}, {0, 0, -2 * z}, up, side, 0.6f));
  const double t = 0.014, s = 0.09;
  out.push_back(boxes("skirting",
                      {{Vector3d(-x, 0, -z), Vector3d(x, s, -z + t)},
                       {Vector3d(-x, 0, z - t), Vector3d(x, s, z)},
                       {Vector3d(-x, 0, -z), Vector3d(-x + t, s, z)},
                       {Vector3d(x - t, 0, -z), Vector3d(x, s, z)}},
                      {0.88f, 0.87f, 0.84f}, 0.6f));
}

void add_door(const Half& half, std::vector<RaySurface>& out) {
  const double z = -half.z, height = std::min(2.05, half.height - 0.15), left = 0.55 * half.x, right = left + 0.85;
  if (right + 0.1 > half.x) return;
  out.push_back(
      boxes("door", {{Vector3d(left, 0.005, z), Vector3d(right, height, z + 0.02)}}, {0.62f, 0.45f, 0.30f}, 0.45f));
  out.push_back(boxes("door frame",
                      {{Vector3d(left - 0.07, 0, z), Vector3d(left, height + 0.07, z + 0.035)},
                       {Vector3d(right, 0, z), Vector3d(right + 0.07, height + 0.07, z + 0.035)},
                       {Vector3d(left, height, z), Vector3d(right, height + 0.07, z + 0.035)}},
                      {0.90f, 0.89f, 0.86f}, 0.6f));
  out.push_back(boxes("handle", {{Vector3d(left + 0.05, 1.02, z + 0.02), Vector3d(left + 0.17, 1.045, z + 0.06)}},
                      {0.35f, 0.34f, 0.33f}, 0.2f));
}

// A desk in one corner, shelves in another, a chair and a box: all within half a metre of the walls.
void add_furniture(const Half& half, std::vector<RaySurface>& out) {
  const double x = half.x, z = half.z;
  const double depth = std::min(0.6, 0.25 * std::min(x, z));
  const Vector3d desk(-x, 0, -z);
  const double w = std::min(1.3, 0.55 * x), h = 0.73, t = 0.03, leg = 0.05;
  std::vector<std::array<Vector3d, 2>> parts{{desk + Vector3d(0.03, h, 0.03), desk + Vector3d(w, h + t, depth)}};
  for (const double lx : {0.05, w - leg - 0.02})
    for (const double lz : {0.05, depth - leg - 0.02})
      parts.push_back({desk + Vector3d(lx, 0, lz), desk + Vector3d(lx + leg, h, lz + leg)});
  out.push_back(boxes("desk", parts, {0.70f, 0.55f, 0.38f}, 0.5f));
  out.push_back(boxes("monitor",
                      {{desk + Vector3d(0.35, h + t + 0.10, 0.18), desk + Vector3d(0.87, h + t + 0.43, 0.22)},
                       {desk + Vector3d(0.57, h + t, 0.17), desk + Vector3d(0.65, h + t + 0.12, 0.21)},
                       {desk + Vector3d(0.48, h + t, 0.12), desk + Vector3d(0.74, h + t + 0.015, 0.30)}},
                      {0.09f, 0.09f, 0.10f}, 0.15f));
  const Vector3d shelf(x, 0, z);
  parts.clear();
  const double sw = std::min(0.9, 0.35 * x), sh = std::min(1.8, half.height - 0.3), sd = std::min(0.32, depth);
  for (int i = 0; i <= 5; ++i) {
    const double y = i * (sh - 0.02) / 5;
    parts.push_back({shelf + Vector3d(-sw, y, -sd), shelf + Vector3d(-0.01, y + 0.02, -0.01)});
  }
  parts.push_back({shelf + Vector3d(-sw - 0.02, 0, -sd), shelf + Vector3d(-sw, sh, -0.01)});
  parts.push_back({shelf + Vector3d(-0.03, 0, -sd), shelf + Vector3d(-0.01, sh, -0.01)});
  out.push_back(boxes("shelf", parts, {0.80f, 0.76f, 0.68f}, 0.55f));
  const Vector3f covers[5] = {
      {.55f, .17f, .15f}, {.16f, .27f, .45f}, {.22f, .40f, .24f}, {.75f, .66f, .40f}, {.30f, .28f, .30f}};
  for (int color = 0; color < 5; ++color) {
    parts.clear();
    for (int level = 0; level < 5; ++level) {
      double left = 0.03;
      for (int book = 0; left < sw - 0.10; ++book) {
        const auto random = uniform4(7, stream_of("books"), level * 100 + book);
        const double thick = 0.018 + 0.03 * random[0], tall = 0.18 + 0.10 * random[1];
        const double y = level * (sh - 0.02) / 5 + 0.02;
        if (static_cast<int>(5 * random[2]) == color && random[3] > 0.15)
          parts.push_back({shelf + Vector3d(-sw + left, y, -sd + 0.05),
                           shelf + Vector3d(-sw + left + thick - 0.002, y + tall, -0.04)});
        left += thick;
      }
    }
    out.push_back(boxes("books", parts, covers[color], 0.3f + 0.08f * color));
  }
  const Vector3d chair(-x + 0.12, 0, z - 0.12);
  out.push_back(boxes("chair",
                      {{chair + Vector3d(0, 0.44, -0.44), chair + Vector3d(0.44, 0.48, 0)},
                       {chair + Vector3d(0, 0.48, -0.03), chair + Vector3d(0.44, 0.92, 0)},
                       {chair + Vector3d(0, 0, -0.04), chair + Vector3d(0.04, 0.44, 0)},
                       {chair + Vector3d(0.40, 0, -0.04), chair + Vector3d(0.44, 0.44, 0)},
                       {chair + Vector3d(0, 0, -0.44), chair + Vector3d(0.04, 0.44, -0.40)},
                       {chair + Vector3d(0.40, 0, -0.44), chair + Vector3d(0.44, 0.44, -0.40)}},
                      {0.24f, 0.26f, 0.30f}, 0.35f));
  out.push_back(boxes("carton", {{Vector3d(x - 0.52, 0, -z + 0.05), Vector3d(x - 0.07, 0.38, -z + 0.42)}},
                      {0.66f, 0.52f, 0.36f}, 0.6f));
}

void add_wall_images(const Half& half, std::vector<RaySurface>& out) {
  const auto hang = [&](const char* name, const Vector3d& corner, const Vector3d& u, double height_m, int number) {
    out.push_back(imaged(name, corner, u, {0, height_m, 0}, paint_poster(u.norm(), height_m, number), 0.5f));
  };
  const double gap = 0.012;
  hang("poster", {-0.35 * half.x, 1.15, -half.z + gap}, {0.6, 0, 0}, 0.85, 1);
  hang("poster", {half.x - gap, 1.1, -0.45 * half.z}, {0, 0, 0.9}, 0.6, 2);
  hang("poster", {-half.x + gap, 1.2, 0.6 * half.z}, {0, 0, -0.7}, 0.5, 3);
  hang("poster", {0.3 * half.x, 1.2, half.z - gap}, {-0.8, 0, 0}, 0.55, 4);
}

// Where the calf is: centre and rearmost point of the left leg's section.
struct Calf {
  double x, back, height;
};
Calf find_calf(const Body& body) {
  const double height = 0.5 * (body.landmarks.ankle + body.landmarks.knee) + 0.03;
  double least = 1e9, most = -1e9, back = 1e9;
  for (const auto& v : body.mesh.vertices) {
    if (std::abs(v.y() - height) > 0.02 || v.x() <= 0) continue;
    least = std::min(least, v.x()), most = std::max(most, v.x()), back = std::min(back, v.z());
  }
  if (least > most) return {0.1, -0.06, height};
  return {0.5 * (least + most), back, height};
}

}  // namespace

std::vector<RaySurface> make_room(const RoomSpec& room) {
  const Half half{0.5 * room.width_m, 0.5 * room.depth_m, room.height_m};
  std::vector<RaySurface> result;
  add_shell(half, result);
  if (!room.furniture) return result;
  add_door(half, result);
  add_furniture(half, result);
  add_wall_images(half, result);
  return result;
}

std::vector<RaySurface> make_bulbs(const std::vector<LightSpec>& lights) {
  std::vector<RaySurface> result;
  for (const auto& light : lights) {
    RaySurface bulb = plain("bulb", sphere_mesh(light.position_m, 0.5 * light.radius_m, 8), Vector3f::Ones(), 0.3f);
    bulb.smooth = true;
    const double disc_m2 = M_PI * light.radius_m * light.radius_m;
    bulb.material.emission_rgb = (light.intensity_rgb / disc_m2).cast<float>();
    result.push_back(std::move(bulb));
  }
  return result;
}

std::vector<RaySurface> make_stand(const Body& body) {
  const Calf calf = find_calf(body);
  Mesh mesh = cylinder_mesh({0, 0.0, -0.03}, {0, 0.006, -0.03}, 0.22, 64);
  append(mesh, cylinder_mesh({calf.x, 0.006, calf.back - 0.004}, {calf.x, calf.height, calf.back - 0.004}, 0.008, 24));
  RaySurface stand = plain("stand", std::move(mesh), Vector3f::Constant(0.86f), 0.5f);
  stand.material.chrome = true;
  return {stand};
}

std::vector<RaySurface> make_rig_hardware(const std::vector<SensorSpec>& rig) {
  Mesh housings, tripods;
  for (const auto& sensor : rig) {
    const Isometry3d& pose = sensor.world_from_sensor;
    Mesh housing = box_mesh({-0.11, -0.035, -0.05}, {0.14, 0.03, 0.012});
    append(housings, transformed(housing, pose.matrix()));
    const Vector3d top = pose * Vector3d(0.015, 0.03, -0.02), hub(top.x(), 0.55 * top.y(), top.z());
    append(tripods, cylinder_mesh(hub, top, 0.014, 12));
    for (int leg = 0; leg < 3; ++leg) {
      const double angle = 2 * M_PI * leg / 3 + std::atan2(top.x(), top.z());
      append(tripods,
             cylinder_mesh(hub, Vector3d(top.x() + 0.28 * std::sin(angle), 0, top.z() + 0.28 * std::cos(angle)), 0.011,
                           12));
    }
  }
  return {plain("sensor housings", std::move(housings), {0.10f, 0.10f, 0.11f}, 0.12f),
          plain("tripods", std::move(tripods), {0.16f, 0.16f, 0.17f}, 0.2f)};
}

}  // namespace dressform
