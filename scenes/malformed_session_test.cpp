// Damage of every kind, drawn by seed, to small valid sessions and recordings: each is refused by an InputError of one
// line that names the damaged file, and nothing is left behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <random>

#include "scenes/file_bytes.h"
#include "scenes/import/import.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

using Draw = std::mt19937_64;
std::size_t below(Draw& draw, std::size_t count) { return static_cast<std::size_t>(draw() % count); }
template <class T>
const T& one_of(Draw& draw, const std::vector<T>& values) {
  return values[below(draw, values.size())];
}

void write_bytes(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

// All places of a document at which a value stands that readers ask for.
std::vector<json::json_pointer> places_of(const json& document, const std::vector<std::string>& ignored) {
  std::vector<json::json_pointer> result;
  const json flat = document.flatten();
  for (const auto& [pointer, value] : flat.items()) {
    const auto asked = [&](const std::string& part) { return pointer.find(part) == std::string::npos; };
    if (std::all_of(ignored.begin(), ignored.end(), asked)) result.emplace_back(pointer);
  }
  return result;
}

// A value that is wrong wherever `right` is right.
json wrong_value(Draw& draw, const json& right) {
  std::vector<json> values{nullptr, json::array(), json::object(), json::array({json::object()})};
  if (!right.is_string()) values.push_back("text");
  if (!right.is_boolean()) values.push_back(true);
  if (right.is_string()) values.insert(values.end(), {1, 1.5, "../x", std::string(5000, 'x')});
  if (right.is_number()) values.insert(values.end(), {1e300, -1e300, -1e9});
  return one_of(draw, values);
}

struct Damage {
  std::string file, what;
};

// Puts one wrong value into a JSON file, or takes one away.
Damage damage_value(Draw& draw, const fs::path& root, const std::string& name,
                    const std::vector<std::string>& ignored) {
  json document = json::parse(std::ifstream(root / name));
  const auto pointer = one_of(draw, places_of(document, ignored));
  std::string what = pointer.to_string();
  if (below(draw, 4) == 0) {
    json& parent = document.at(pointer.parent_pointer());
    if (parent.is_array())
      parent.erase(parent.size() - 1);
    else
      parent.erase(pointer.back());
    what += " gone";
  } else {
    document[pointer] = wrong_value(draw, document[pointer]);
    what += " = " + document[pointer].dump().substr(0, 40);
  }
  write_bytes(root / name, document.dump());
  return {name, what};
}

// Damages a text file as a whole.
Damage damage_text(Draw& draw, const fs::path& root, const std::string& name) {
  std::string text = read_file_bytes(root / name);
  switch (below(draw, 5)) {
    case 0:
      text.resize(below(draw, text.size() - 2));
      break;
    case 1:
      text = std::string(1 + below(draw, 2000), '[');
      break;
    case 2:
      text.insert(below(draw, text.size() / 2), std::string("\0\xff\xfe", 3));
      break;
    case 3:
      fs::remove(root / name);
      return {name, "removed"};
    default:
      fs::remove(root / name), fs::create_directory(root / name);
      return {name, "a folder"};
  }
  write_bytes(root / name, text);
  return {name, "text"};
}

cv::Mat wrong_image(Draw& draw) {
  const std::vector<int> types{CV_8UC4, CV_16UC3, CV_16UC4};  // that no image of a session or recording is
  return cv::Mat(13, 17, one_of(draw, types), cv::Scalar::all(9));
}

Damage damage_image(Draw& draw, const fs::path& root, const std::string& name, int kinds = 6) {
  std::string bytes = read_file_bytes(root / name);
  std::string what = "cut";
  switch (below(draw, static_cast<std::size_t>(kinds))) {
    case 0:
      bytes.resize(below(draw, bytes.size() - 12));
      break;
    case 1:
      what = "a flipped bit", bytes[below(draw, bytes.size())] ^= static_cast<char>(1 << below(draw, 8));
      break;
    case 2:
      what = "a huge size", bytes.replace(16, 4, std::string("\x7f\xff\xff\xff", 4));
      break;
    case 3: {
      std::vector<unsigned char> other;
      cv::imencode(".png", wrong_image(draw), other);
      what = "another kind", bytes.assign(other.begin(), other.end());
      break;
    }
    case 4:
      what = "text", bytes = "P5 not an image";
      break;
    default:
      fs::remove(root / name), fs::create_directory(root / name);
      return {name, "a folder"};
  }
  write_bytes(root / name, bytes);
  return {name, what};
}

// A valid folder that a test copies, damages and reads.
class MalformedSession : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(testing::TempDir()) /
            ("malformed_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(root_);
    fs::create_directories(whole_ = root_ / "whole");
  }
  void TearDown() override { fs::remove_all(root_); }

  cv::Mat depth(cv::Size size, int stream) const {
    cv::Mat image(size, CV_16UC1);
    cv::RNG(static_cast<std::uint64_t>(stream)).fill(image, cv::RNG::UNIFORM, 800, 3500);
    return image;
  }
  void image(const std::string& name, const cv::Mat& image) const {
    fs::create_directories((whole_ / name).parent_path());
    cv::imwrite((whole_ / name).string(), image);
  }

  void expect_refused(int count, const std::function<Damage(Draw&, const fs::path&)>& damage,
                      const std::function<void(const fs::path&)>& read) const {
    read(whole_);  // what is whole passes
    for (int seed = 0; seed < count; ++seed) {
      Draw draw(static_cast<unsigned>(seed) + 1);
      const fs::path copy = root_ / "copy";
      fs::remove_all(copy);
      fs::copy(whole_, copy, fs::copy_options::recursive);
      const Damage done = damage(draw, copy);
      SCOPED_TRACE("seed " + std::to_string(seed) + ": " + done.file + ": " + done.what);
      try {
        read(copy);
        ADD_FAILURE() << "was read";
      } catch (const InputError& error) {
        const std::string text = error.what();
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
        EXPECT_THAT(text, HasSubstr(fs::path(done.file).filename().string()));
      }
    }
  }
  fs::path root_, whole_;
};

SensorCalibration small_sensor() {
  SensorCalibration sensor;
  sensor.model = "kinect_v2";
  sensor.color = Camera{48, 27, 27, 27, 23.5, 13, {0.01, 0, 0, 0, 0}};
  sensor.ir = Camera{32, 26, 23, 23, 15.5, 12.5, {0.01, 0, 0, 0, 0}};
  sensor.color_from_ir.translation() = Vector3d(0.05, 0, 0);
  return sensor;
}

TEST_F(MalformedSession, Sessions) {
  CaptureSession session;
  session.name = "small";
  session.sensors = {"k1", "k2"};
  session.calibration.emplace();
  for (const auto& name : session.sensors) {
    session.calibration->sensors[name] = small_sensor();
    for (auto* shots : {&session.naked, &session.dressed}) {
      Shot& shot = (*shots)[name];
      shot.color = cv::Mat(cv::Size(48, 27), CV_8UC3, cv::Scalar(1, 2, 3));
      shot.depth_mm = depth({32, 26}, 3);
      shot.ir = depth({32, 26}, 4);
      shot.skeleton = Skeleton{{"Head", {Vector3d(0.1, 0.2, 2), true}}};
    }
  }
  session.scans["scan_naked"] = {"k1", {depth({32, 26}, 5), depth({32, 26}, 6)}};
  session.prior.emplace();
  for (const auto& name : session.sensors) {
    Isometry3d& pose = session.prior->world_from_sensor[name] = Isometry3d::Identity();
    pose.linear() = Vector3d(1, -1, -1).asDiagonal();
    pose.translation() = Vector3d(0, 1.2, 2);
  }
  fs::remove_all(whole_);
  write_capture_session(whole_, session);
  // Not asked for, or right in many ways: texts that nobody reads; poses and cameras have tests of their own numbers.
  const std::vector<std::string> free{"created_by",     "licence", "/name",      "/model",
                                      "depth_offset_m", "_sigma",  "/sensors/1", "/shots/"};
  const std::vector<std::string> images{"naked/k1/depth.png", "naked/k2/color.png", "dressed/k1/ir.png",
                                        "scan_naked/0001_depth.png"};
  expect_refused(
      300,
      [&](Draw& draw, const fs::path& copy) {
        const std::vector<std::string> texts{"session.json", "calibration.json", "naked/k1/skeleton.json"};
        switch (below(draw, 3)) {
          case 0:
            return damage_value(draw, copy, one_of(draw, texts), free);
          case 1:
            return damage_text(draw, copy, texts[below(draw, 2)]);  // the third need not be there
          default:
            return damage_image(draw, copy, one_of(draw, images));
        }
      },
      [](const fs::path& folder) { read_capture_session(folder); });
}

TEST_F(MalformedSession, Recordings) {
  for (int i = 0; i < 3; ++i) {
    image("depth/" + std::to_string(i) + ".png", depth({32, 26}, i));
    image("rgb/" + std::to_string(i) + ".png", cv::Mat(cv::Size(32, 26), CV_8UC3, cv::Scalar(1, 2, 3)));
  }
  json cameras;
  for (int i = 0; i < 3; ++i)
    cameras[std::to_string(i)] = {{"cam_K", {23, 0, 15.5, 0, 23, 12.5, 0, 0, 1}}, {"depth_scale", 1.0}};
  write_bytes(whole_ / "scene_camera.json", cameras.dump());
  const fs::path session = root_ / "session";
  expect_refused(
      120,
      [&](Draw& draw, const fs::path& copy) {
        switch (below(draw, 3)) {
          case 0:
            return damage_value(draw, copy, "scene_camera.json", {});
          case 1:
            return damage_text(draw, copy, "scene_camera.json");
          default:
            return damage_image(draw, copy, "depth/" + std::to_string(below(draw, 3)) + ".png",
                                5);  // a folder is no frame
        }
      },
      [&](const fs::path& folder) {
        ImportRequest request;
        request.format = "bop";
        request.role = "scan_user";
        fs::remove_all(session);
        import_recording(folder, request, session);
      });
  EXPECT_FALSE(fs::exists(session));
}

}  // namespace
}  // namespace dressform
