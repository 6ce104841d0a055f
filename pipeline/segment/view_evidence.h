#pragma once
#include <opencv2/core/mat.hpp>
#include <string>

#include "pipeline/body/body_landmarks.h"
#include "pipeline/geometry/mesh_query.h"
#include "pipeline/segment/segment.h"

namespace dressform {

// The naked model as the segmentation asks it.
struct NakedBody {
  explicit NakedBody(const KnownBody& known) : query(known.body), limbs(known.landmarks) {}
  MeshQuery query;
  Landmarks limbs;
};

// What one dressed view says, pixel by pixel, on a crop of its colour image round the mannequin. Images have the size
// of `box`. Where a colour pixel has no depth of its own, `place` and `part` come from the nearest one that has.
struct ViewEvidence {
  cv::Rect box;        // in the colour image; empty when the view is of no use
  cv::Mat body;        // uint8: 255 where the mannequin is
  cv::Mat lab;         // smoothed_lab of the dressed shot
  cv::Mat measured;    // uint8: 255 where the pixel has depth of its own
  cv::Mat place_m;     // float32 x 3, model frame; NaN = none near
  cv::Mat part;        // uint8 BodyPart of the nearest place of the naked model; 255 = none
  cv::Mat limb_end;    // float32: how far along its arm or leg, 0 root, 1 fingers or toes; 0 on torso and head
  cv::Mat offset_mm;   // float32: distance outside the naked body, noise smoothed; NaN where not measured
  cv::Mat change;      // float32: colour change against the naked shot, shadows allowed for, in units of its noise;
                       // NaN where the naked shot does not show the body there
  cv::Mat shadow;      // uint8: 255 where that change is a shadow
  cv::Mat uncovered;   // uint8: 255 where the naked shot shows the surroundings
  cv::Mat naked_lab;   // smoothed_lab of the naked shot, exposure matched; empty without a naked shot
  cv::Mat naked_body;  // uint8: the naked shot's mannequin
  bool moved = false;  // the mannequin moved between the shots: the naked shot says nothing pixel by pixel
};

// Places that clothes leave bare.
enum class ExposedSkin : unsigned char { none, head, hand, foot };
ExposedSkin exposed_skin(const ViewEvidence& view, int v, int u);

struct EvidenceParams {
  double moved_mm = 8;   // median depth change of head and hands beyond which the mannequin moved
  double stand_mm = 30;  // unchanged and further from the naked body than this: the stand
};

// `shots` of a registered view.
ViewEvidence view_evidence(const Shot& dressed, const Shot* naked, const SensorCalibration& sensor,
                           const ViewMasks& masks, const Isometry3d& model_from_sensor, const NakedBody& body,
                           const EvidenceParams& params);

}  // namespace dressform
