#pragma once
#include <filesystem>
#include <string>

#include "eval/score/scores.h"
#include "scenes/camera.h"
#include "scenes/mesh_frame.h"

namespace dressform {

// How the estimate is brought to the truth. none: the files are in one frame. gauge: the one rigid motion that no
// sensor pose fixes here is taken out first (rigid_fit.h); scores then say nothing of the pose.
enum class MeshAlignment { none, gauge };

struct MeshPairScores {
  Scores scores;                                            // of the stages surface, open and texture; slot "mesh"
  Isometry3d truth_from_estimate = Isometry3d::Identity();  // what was taken out
};

// Scores one mesh against another, without session or run: any OBJ, PLY or GLB. The truth is in metres, y up; `frame`
// says how the estimate's coordinates are meant. A PLY's vertex property `views` says
// what was observed; the rims of the truth are its own boundary loops; textures are compared where both files have one,
// else their rows are absent. Throws InputError naming the file: unreadable, or of a size that no person or garment
// has.
MeshPairScores score_mesh_pair(const std::filesystem::path& estimate, const std::filesystem::path& truth,
                               MeshAlignment alignment, const MeshFrame& frame = {});

}  // namespace dressform
