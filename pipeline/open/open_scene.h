#pragma once
#include <vector>

#include "pipeline/geometry/mesh_query.h"
#include "pipeline/imaging/depth_view.h"
#include "pipeline/segment/segment.h"

namespace dressform {

// What all garments of one session are opened with.
struct OpenScene {
  const CaptureSession& session;
  const Segmentation& segmentation;
  const Landmarks& landmarks;
  std::vector<DepthView> views;
  MeshQuery naked;

  // The part of the body nearest to a point.
  BodyPart part_below(const Vector3d& point) const { return landmarks.part_of(naked.closest(point).triangle); }
};

}  // namespace dressform
