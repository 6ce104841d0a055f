#pragma once
#include <map>
#include <string>

#include "pipeline/body/body_landmarks.h"
#include "pipeline/fill/fill.h"
#include "pipeline/garment/garment_layout.h"
#include "pipeline/run/stage.h"

namespace dressform {

struct ClosedGarment {
  Mesh mesh;             // closed, manifold, one component, outward, model frame
  PointCloud support;    // the points it was made from, outliers removed; views = index into CaptureSession::sensors
  GarmentLayout layout;  // refined: ends by the points, order where both are there, kind of the surface that came out

  template <class Archive>
  void serialize(Archive& archive) {
    archive(mesh, support, layout);
  }
};
struct ClosedGarments {
  std::map<std::string, ClosedGarment> garments;  // "top", "bottom"

  template <class Archive>
  void serialize(Archive& archive) {
    archive(garments);
  }
};

struct SurfaceTag {
  static constexpr const char* name = "surface";
  static constexpr const char* default_variant = "layer";
};
// A closed surface of every garment, which runs on a little beyond its ends and is capped there. In: the dressed depth
// (mm, raw), the naked body and its landmarks, the filled views and the layouts that segment found. Out: m, model
// frame: triangles that are closed, manifold, outward and of one piece, and the points they were made from. Garments
// that too few points show are absent. Views that are not registered are left out. Throws InputError for a body without
// triangles. The thesis (section 3.4.1) uses Poisson's reconstruction (Kazhdan, Bolitho and Hoppe, SGP 2006), which
// closes armpits with webs; the variants' files name what they do instead.
using Surface = Stage<SurfaceTag, ClosedGarments(const CaptureSession&, const Calibration&, const KnownBody& naked,
                                                 const Registration&, const FilledViews&, const GarmentLayouts&)>;

}  // namespace dressform
