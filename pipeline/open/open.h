#pragma once
#include <map>
#include <string>
#include <vector>

#include "pipeline/body/body_landmarks.h"
#include "pipeline/garment/garment_layout.h"
#include "pipeline/run/stage.h"
#include "pipeline/segment/segment.h"
#include "pipeline/surface/surface.h"

namespace dressform {

struct Rim {
  std::string name;              // "neck", "left_cuff", "right_cuff", "hem", "waist", "left_ankle", "right_ankle"
  std::vector<Vector3d> points;  // closed, model frame
  bool observed = true;          // false where no view saw the edge (a waist under a shirt)
  std::vector<char> hidden;      // of each point: no view saw this stretch (a neck's front under a chin); empty: none

  // Part of its length that no view saw and that goes on from what was seen, 0 to 1; 1 where it is not observed.
  double unseen_part() const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(name, points, observed, hidden);
  }
};
inline double Rim::unseen_part() const {
  double total = 0, unseen = 0;
  for (std::size_t i = 0; i < hidden.size(); ++i) {
    const double length = (points[(i + 1) % points.size()] - points[i]).norm();
    total += length;
    if (hidden[i]) unseen += length;
  }
  return !observed ? 1 : total > 0 ? unseen / total : 0;
}

struct OpenGarment {
  Mesh mesh;              // open, manifold, one component; shirt 4 loops, trousers 3, skirt 2
  std::vector<Rim> rims;  // one per loop
  GarmentLayout layout;   // refined: the sleeves end at the rims

  template <class Archive>
  void serialize(Archive& archive) {
    archive(mesh, rims, layout);
  }
};
struct OpenGarments {
  std::map<std::string, OpenGarment> garments;  // "top", "bottom"
  std::map<std::string, std::string> failed;    // of the closed garments that could not be opened: why not

  template <class Archive>
  void serialize(Archive& archive) {
    archive(garments, failed);
  }
};

struct OpenTag {
  static constexpr const char* name = "open";
  static constexpr const char* default_variant = "limb_spline";
};
// The closed garments cut open at neck, cuffs, hem, waist and ankles. In: the dressed shots and labels, poses, the
// naked body and its landmarks, closed garments with their layouts (m, model frame). Out: m, model frame: manifold, of
// one piece, with one boundary loop for each rim, and the rims by name. A garment that does not come out as one piece
// with a loop for each opening is absent, and `failed` says why. Throws InputError for a body without triangles. The
// thesis (section 3.4.2) picks points along the rims by hand and deletes the faces beyond.
using Open = Stage<OpenTag, OpenGarments(const CaptureSession&, const Calibration&, const KnownBody& naked,
                                         const Registration&, const Segmentation&, const ClosedGarments&)>;

}  // namespace dressform
