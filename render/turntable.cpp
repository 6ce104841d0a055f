#include "render/turntable.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "render/geometry.h"
#include "scenes/error.h"
#include "scenes/file_bytes.h"
#include "scenes/image_file.h"
#include "scenes/new_folder.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

std::string ffmpeg_path() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const fs::path file = fs::path(folder) / "ffmpeg"; ::access(file.c_str(), X_OK) == 0) return file.string();
  return "";
}

std::string frame_name(std::size_t number) {
  char name[32];
  std::snprintf(name, sizeof name, "frame_%03zu.png", number);
  return name;
}

void write_frames(const std::vector<cv::Mat>& frames, const fs::path& folder) {
  for (std::size_t i = 0; i < frames.size(); ++i) write_png(folder / frame_name(i), frames[i]);
}

// Runs a program with its words going into a file; true when it ended well. No shell: names may hold anything.
bool run_quietly(const std::vector<std::string>& words, const fs::path& log) {
  const pid_t child = ::fork();
  if (child < 0) return false;
  if (child == 0) {
    const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), in = ::open("/dev/null", O_RDONLY);
    ::dup2(in, 0), ::dup2(out, 1), ::dup2(out, 2);
    std::vector<char*> arguments;
    for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    ::execv(arguments[0], arguments.data());
    ::_exit(127);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

// One thread and no dates or names of the encoder, so that the same frames give the same bytes.
std::vector<std::string> encoder_words(const std::string& ending) {
  if (ending == ".webp") return {"-c:v", "libwebp", "-lossless", "0", "-quality", "85", "-loop", "0"};
  return {"-c:v",      "libx264",   "-crf", "18", "-pix_fmt", "yuv420p", "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2",
          "-movflags", "+faststart"};
}

std::string last_line(const std::string& text) {
  std::istringstream lines(text);
  std::string last;
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) last = line;
  return last;
}

// A folder that goes when it is left.
struct ScratchFolder {
  fs::path path;
  ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "dressform-frames-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw InputError(name, "can't be made; expected a folder for temporary files");
    path = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
};

}  // namespace

bool has_ffmpeg() { return !ffmpeg_path().empty(); }

std::vector<cv::Mat> turntable_frames(Renderer& renderer, const std::vector<RenderItem>& items,
                                      const TurntableOptions& options) {
  const Eigen::AlignedBox3d box = bounding_box(items);
  if (box.isEmpty() || options.frames < 2 || options.height_px < 8)
    throw std::invalid_argument("turntable_frames: something to draw, two frames and eight pixels are needed");
  const double part = std::hypot(box.sizes().x(), box.sizes().z()) / std::max(1e-6, box.sizes().y());
  const int width = 2 * static_cast<int>(std::lround(0.5 * options.height_px * std::clamp(part, 0.4, 1.6)));
  std::vector<RenderView> views;
  for (int i = 0; i < options.frames; ++i)
    views.push_back(
        look_at_box(box.min(), box.max(), 360.0 * i / options.frames, options.elevation_deg, width, options.height_px));
  return renderer.render(views, items);
}

fs::path write_animation(const std::vector<cv::Mat>& frames, double frames_per_second, const fs::path& file) {
  const std::string ending = file.extension().string(), ffmpeg = ffmpeg_path();
  if (ffmpeg.empty() || (ending != ".webp" && ending != ".mp4")) {
    const fs::path folder = fs::path(file).replace_extension();
    NewFolder writer(folder);
    write_frames(frames, writer.temporary());
    writer.keep();
    return folder;
  }
  const ScratchFolder scratch;
  write_frames(frames, scratch.path);
  const fs::path made = scratch.path / ("made" + ending), log = scratch.path / "log";
  std::vector<std::string> words{ffmpeg,
                                 "-y",
                                 "-nostdin",
                                 "-loglevel",
                                 "error",
                                 "-threads",
                                 "1",
                                 "-framerate",
                                 std::to_string(frames_per_second),
                                 "-i",
                                 (scratch.path / "frame_%03d.png").string()};
  for (const auto& word : encoder_words(ending)) words.push_back(word);
  for (const char* word :
       {"-threads", "1", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1", "-an"})
    words.push_back(word);
  words.push_back(made.string());
  if (!run_quietly(words, log))
    throw InputError(file.string(), "ffmpeg could not write it (" + last_line(read_file_bytes(log)) +
                                        "); expected an ffmpeg with libwebp or libx264");
  write_file_atomically(file, read_file_bytes(made));
  return file;
}

}  // namespace dressform
