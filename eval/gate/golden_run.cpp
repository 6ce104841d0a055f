#include "eval/gate/golden_run.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "scenes/error.h"

namespace dressform {
namespace {

constexpr int kImageHeight = 220;

cv::Mat small_image(const std::filesystem::path& file) {
  const cv::Mat image = cv::imread(file.string(), cv::IMREAD_COLOR);
  if (image.empty()) throw std::runtime_error(file.string() + ": the run made no such image");
  cv::Mat result;
  cv::resize(image, result, {image.cols * kImageHeight / image.rows, kImageHeight}, 0, 0, cv::INTER_AREA);
  return result;
}

}  // namespace

GoldenRun run_golden_case(const GoldenCase& golden_case, const std::filesystem::path& golden,
                          const std::filesystem::path& work, int threads, const SceneRunProgress& progress) {
  const auto root = std::filesystem::absolute(golden).lexically_normal().parent_path();
  SceneRunRequest request{scaled(read_scene(root / golden_case.scene), golden_case.scale),
                          golden_case.scale,
                          work / golden_case.name,
                          work / ".dressform-store",
                          "default",
                          {},
                          threads};
  request.options.seed = golden_case.seed;
  const auto result = run_scene(request, progress);
  GoldenRun run{result.scores.value(), {}};
  for (const char* name : {"result_mannequin", "result_user"})
    run.images[name] = small_image(request.output / "renders" / (std::string(name) + ".png"));
  return run;
}

}  // namespace dressform
