// Faults in the labelled and filled images of the clothes.
#include <opencv2/core.hpp>

#include "eval/gate/power/fault.h"
#include "eval/gate/power/fault_shapes.h"
#include "pipeline/fill/fill.h"
#include "pipeline/segment/segment.h"

namespace dressform {
namespace {

constexpr auto kTop = static_cast<unsigned char>(Label::top), kBottom = static_cast<unsigned char>(Label::bottom),
               kNone = static_cast<unsigned char>(Label::none);

cv::Mat* labels_of_one(Segmentation& segmentation, const Placement& place) {
  const auto found = segmentation.labels.find(place.one_of(segmentation.labels));
  return found == segmentation.labels.end() || found->second.empty() ? nullptr : &found->second;
}

void shift_labels(Segmentation& segmentation, double size_px, const Placement& place) {
  if (cv::Mat* labels = labels_of_one(segmentation, place)) shift_image(*labels, static_cast<int>(size_px), 0);
}

// Cloth grows over what is beside it, on all sides of it.
void bleed(Segmentation& segmentation, double size_px, const Placement& place) {
  cv::Mat* labels = labels_of_one(segmentation, place);
  if (!labels) return;
  const unsigned char label = place.uniform(2) < 0.5 ? kTop : kBottom;
  cv::Mat grown = *labels == label;
  grow_mask(grown, static_cast<int>(size_px));
  labels->setTo(label, grown);
}

void speckle(Segmentation& segmentation, double size_percent, const Placement& place) {
  cv::Mat* labels = labels_of_one(segmentation, place);
  if (!labels) return;
  for (int y = 0; y < labels->rows; ++y)
    for (int x = 0; x < labels->cols; ++x)
      if (auto& label = labels->at<unsigned char>(y, x);
          label >= kTop && 100 * place.uniform(1000 + y * labels->cols + x) < size_percent)
        label = kNone;
}

// The border between top and bottom lower by so many rows, in all views.
void lower_border(Segmentation& segmentation, double size_px, const Placement&) {
  for (auto& [sensor, labels] : segmentation.labels)
    for (int x = 0; x < labels.cols; ++x)
      for (int y = labels.rows - 2; y >= 0; --y)
        if (labels.at<unsigned char>(y, x) == kTop && labels.at<unsigned char>(y + 1, x) == kBottom)
          for (int below = y + 1; below <= y + static_cast<int>(size_px) && below < labels.rows; ++below)
            if (labels.at<unsigned char>(below, x) == kBottom) labels.at<unsigned char>(below, x) = kTop;
}

void shorten_sleeves(Segmentation& segmentation, double size_mm, const Placement&) {
  for (auto& [slot, layout] : segmentation.garments)
    for (auto* limbs : {&layout.arms, &layout.legs})
      for (auto& limb : *limbs)
        if (limb.covered) limb.end_m -= size_mm / 1000, limb.end_y += size_mm / 1000;
}

FilledGarment* one_filled(FilledViews& filled, const Placement& place) {
  const auto slot = filled.garments.find(place.one_of(filled.garments));
  if (slot == filled.garments.end()) return nullptr;
  const auto view = slot->second.find(place.one_of(slot->second, 1));
  return view == slot->second.end() ? nullptr : &view->second;
}

void deepen(FilledViews& filled, double size_mm, const Placement& place) {
  FilledGarment* garment = one_filled(filled, place);
  if (!garment || garment->depth_mm.empty()) return;
  cv::add(garment->depth_mm, cv::Scalar(size_mm), garment->depth_mm, garment->depth_mm > 0);
}
void tint(FilledViews& filled, double size_levels, const Placement& place) {
  if (FilledGarment* garment = one_filled(filled, place)) add_levels(garment->color, size_levels);
}
void erode_filled(FilledViews& filled, double size_px, const Placement& place) {
  if (FilledGarment* garment = one_filled(filled, place)) grow_mask(garment->mask, -static_cast<int>(size_px));
}
void hole_in_depth(FilledViews& filled, double size_px, const Placement& place) {
  FilledGarment* garment = one_filled(filled, place);
  if (!garment || garment->depth_mm.empty()) return;
  cv::Mat seen;
  cv::findNonZero(garment->depth_mm > 0, seen);
  if (seen.empty()) return;
  const auto at = seen.at<cv::Point>(static_cast<int>(place.uniform(3) * static_cast<double>(seen.total())));
  const int half = static_cast<int>(size_px / 2);
  const cv::Rect hole =
      cv::Rect(at.x - half, at.y - half, 2 * half + 1, 2 * half + 1) & cv::Rect({0, 0}, garment->depth_mm.size());
  garment->depth_mm(hole).setTo(0);
}

}  // namespace

std::vector<Fault> cloth_image_faults() {
  return {
      artifact_fault<Segmentation>("segment", "shifted", "px", {1, 4, 12}, "labels of one view to the right",
                                   shift_labels),
      artifact_fault<Segmentation>("segment", "bled", "px", {1, 4, 12}, "one garment over its edges in one view",
                                   bleed),
      artifact_fault<Segmentation>("segment", "speckled", "%", {1, 5, 25}, "cloth of one view labelled nothing",
                                   speckle),
      artifact_fault<Segmentation>("segment", "border_lowered", "px", {1, 4, 12}, "top and bottom meet lower",
                                   lower_border),
      artifact_fault<Segmentation>("segment", "limbs_shortened", "mm", {10, 40, 120}, "sleeves and legs end early",
                                   shorten_sleeves),
      artifact_fault<FilledViews>("fill", "deepened", "mm", {3, 10, 30}, "depth of a garment in one view", deepen),
      artifact_fault<FilledViews>("fill", "tinted", "levels", {4, 15, 50}, "colours of a garment in one view", tint),
      artifact_fault<FilledViews>("fill", "eroded", "px", {2, 6, 20}, "mask of a garment in one view", erode_filled),
      artifact_fault<FilledViews>("fill", "hole", "px", {6, 20, 60}, "a square without depth in one view",
                                  hole_in_depth),
  };
}

}  // namespace dressform
