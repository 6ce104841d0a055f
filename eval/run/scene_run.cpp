#include "eval/run/scene_run.h"

#include "eval/run/run_folder.h"
#include "synthetic/sensors/sensor_model.h"

namespace dressform {

void choose_sensor(Scene& scene, const VariantChoice& choice) {
  auto& model = scene.sensor_model;
  if (!choice.variant.empty() && choice.variant != model.variant) model = {choice.variant, {}};
  for (const auto& [name, value] : choice.values) model.values[name] = value;
  model.values = SensorModel::at(model.variant).complete(model.values);
}

EndToEndResult run_scene(const SceneRunRequest& request, const SceneRunProgress& progress) {
  check_options(request.options);
  RunFolder::check(request.output);
  ArtifactStore store(request.store);
  const auto capture = stored_capture(request.scene, request.scale, request.options.seed, store, progress.capture);
  if (progress.captured) progress.captured(capture);
  EndToEndRequest pipeline{capture.session, request.output,  store.root(), request.scene.name,
                           request.variant, request.options, false,        request.threads};
  pipeline.report = request.report;
  pipeline.result_images = request.result_images;
  pipeline.oracles = request.oracles;
  pipeline.facts = {{"scene_file", request.scene.file.string()},
                    {"scene_toml", request.scene.toml},
                    {"scale", request.scale},
                    {"sensor_model", request.scene.sensor_model.variant},
                    {"capture",
                     {{"key", capture.recipe.key()},
                      {"seconds", capture.seconds},
                      {"peak_memory_mb", capture.peak_memory_mb},
                      {"reused", capture.reused}}}};
  return run_end_to_end(pipeline, progress.pipeline);
}

}  // namespace dressform
