#include <fmt/format.h>

#include <memory>

#include "eval/cli/commands.h"
#include "eval/cli/options.h"
#include "scenes/import/import.h"
#include "scenes/scene_fields.h"
#include "scenes/session_limits.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

struct ImportOptions : CommonOptions {
  ImportRequest request;
  fs::path recording;
  std::string board, layout;
  std::vector<double> camera, place, sigma;
};

// Text such as "5x7x0.03".
void read_board(const std::string& text, ImportRequest& request) {
  int used = 0;
  const int read = std::sscanf(text.c_str(), "%dx%dx%lf%n", &request.inner_corners_x, &request.inner_corners_y,
                               &request.square_m, &used);
  const bool sound = request.inner_corners_x >= 2 && request.inner_corners_y >= 2 && request.inner_corners_x <= 200 &&
                     request.inner_corners_y <= 200 && std::isfinite(request.square_m);
  if (read != 3 || used != static_cast<int>(text.size()) || !sound)
    throw InputError("--board " + text, "expected inner corners and metres, e.g. 5x7x0.03");
  const std::string problem = problem_with_board(request.inner_corners_x, request.inner_corners_y, request.square_m);
  if (!problem.empty()) throw InputError("--board " + text, problem);
}

Camera camera_of(const std::vector<double>& numbers) {
  Camera camera{0, 0, numbers[0], numbers[1], numbers[2], numbers[3], {}};
  for (std::size_t i = 4; i < numbers.size(); ++i) camera.distortion[i - 4] = numbers[i];
  return camera;
}

void check_numbers(const std::string& option, const std::vector<double>& numbers,
                   std::initializer_list<std::size_t> counts, const std::string& form) {
  const bool right_count = std::find(counts.begin(), counts.end(), numbers.size()) != counts.end();
  const bool finite = std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
  if (!numbers.empty() && (!right_count || !finite))
    throw InputError(option, fmt::format("found {} numbers; expected {}", numbers.size(), form));
}

ImportRequest complete_request(const ImportOptions& options) {
  ImportRequest request = options.request;
  const ReconstructionOptions choices = parse_choices(options).reconstruction;
  for (const auto& [stage, values] : choices.values) {
    if (stage != "import") throw InputError("--set " + stage, "expected import.parameter=value");
    request.values = values;
  }
  if (!options.layout.empty()) {
    if (request.format != "generic") throw InputError("--layout", "found for " + request.format + "; expected generic");
    request.values["layout"] = options.layout;
  }
  if (!options.board.empty()) read_board(options.board, request);
  check_numbers("--camera", options.camera, {4, 9}, "fx,fy,cx,cy or fx,fy,cx,cy,k1,k2,p1,p2,k3");
  check_numbers("--place", options.place, {3}, "azimuth (degrees), distance and height (metres)");
  check_numbers("--place-sigma", options.sigma, {2}, "degrees and metres");
  if (!options.camera.empty()) request.camera = camera_of(options.camera);
  if (!options.place.empty())
    request.world_from_sensor =
        world_from_placed_sensor(SensorPlace{options.place[0], options.place[1], options.place[2], 0, 0, 0});
  if (!options.sigma.empty())
    request.rotation_sigma_deg = options.sigma[0], request.translation_sigma_m = options.sigma[1];
  return request;
}

int import_session(const ImportOptions& options) {
  const ThreadLimit threads(options.threads);
  const ImportReport report = import_recording(options.recording, complete_request(options), options.output);
  fmt::print("{}: {} of {} frames for sensor {}\n", report.role, report.frames, report.recorded, report.sensor);
  const Camera& camera = report.calibration.ir;
  if (report.calibrated)
    fmt::print("camera of depth: {} x {}, fx {:.2f} fy {:.2f} cx {:.2f} cy {:.2f} px, offset {:+.1f} mm\n",
               camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy,
               1000 * report.calibration.depth_offset_m);
  for (const auto& note : report.notes) fmt::print("note: {}\n", note);
  fmt::print("session: {}\n", options.output.string());
  return kSuccess;
}

Command add_import_command(CLI::App& app) {
  auto options = std::make_shared<ImportOptions>();
  ImportRequest& request = options->request;
  auto* command = app.add_subcommand("import", "A capture session from a recording of another tool");
  command->add_option("format", request.format, "what wrote the recording")
      ->required()
      ->check(CLI::IsMember(Importer::names()));
  command->add_option("recording", options->recording, "its folder")->required();
  command->add_option("-o,--output", options->output, "the new session folder")->required();
  command->add_option("--role", request.role,
                      "what it shows: boards, naked, dressed (one moment: --first), scan_naked or scan_user; default "
                      "boards for iai_kinect2, else scan_user");
  command->add_option("--sensor", request.sensor, "name of the sensor; default k1, of scans handheld");
  command->add_option("--model", request.model,
                      "of the sensor: kinect_v2, kinect_v1, ...; default the format's usual one");
  command->add_option("--layout", options->layout,
                      "of a generic recording: a TOML file with patterns, scales, stamps and cameras");
  command->add_option("--with", request.with, "a session to take over, so that sensors and roles add up");
  command->add_option("--board", options->board, "inner corners and square of the board (default 5x7x0.03)");
  command->add_option("--camera", options->camera, "fx,fy,cx,cy[,k1,k2,p1,p2,k3] of the depth images")->delimiter(',');
  command->add_option("--place", options->place, "azimuth,distance,height: where the sensor stood, roughly (deg,m,m)")
      ->delimiter(',');
  command->add_option("--place-sigma", options->sigma, "how roughly: deg,m (default 5,0.08)")->delimiter(',');
  command->add_option("--first", request.first, "first frame to take (default 0)")->check(CLI::Range(0, 1000000));
  command->add_option("--every", request.every, "take every so many frames (default 1)")->check(CLI::Range(1, 1000000));
  command->add_option("--frames", request.most, "take so many at most (default all)")->check(CLI::Range(1, 1000000));
  command->add_option("--name", request.name, "of the session; default the folder's");
  command->add_option("--licence", request.licence, "of the recording; default unknown");
  command
      ->add_option("--set", options->values,
                   "import.parameter=value: a parameter of the format (repeatable); see "
                   "dressform variants import")
      ->allow_extra_args(false);
  add_threads(*command, *options);
  command->footer(
      "Example:\n"
      "  dressform import iai_kinect2 boards/k1 --sensor k1 --board 5x7x0.03 -o sessions/k1\n"
      "  dressform import tum rgbd_dataset_freiburg1_xyz --role scan_user --every 6 --with sessions/k1 -o "
      "sessions/lab\n"
      "  dressform import generic realsense_take --layout realsense.toml --role scan_user -o sessions/take");
  return [options] { return import_session(*options); };
}

const RegisteredCommand registered_import{30, add_import_command};

}  // namespace
}  // namespace dressform
