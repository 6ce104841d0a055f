#pragma once
#include "eval/metrics/image_metrics.h"
#include "render/renderer.h"
#include "scenes/mesh.h"

namespace dressform {

// How an estimated garment looks from where no sensor stood: at 45, 135, 225 and 315 degrees from the front, a little
// above, 2.10 m from the wearer, through the Kinect's nominal colour camera, cut out round the true garment: whatever
// the garment's size, details are judged at the resolution that the sensors have. Both garments are drawn unlit, alone,
// in the world frame, on middle grey. One linear gain per channel for the whole garment is taken out first.
struct HeldOutScores {
  double ssim = 0;           // windows centred on either garment; mean over the views
  double ssim_observed = 0;  // the same without what no sensor saw of the true garment
  double ssim_raw = 0;       // ssim without the gain
  double psnr_db = 0;        // pixels that both cover
  double de2000_mean = 0, de2000_p95 = 0;
  double silhouette_iou = 0;
  cv::Vec3d gain = {1, 1, 1};  // B, G, R
  long pixels = 0;
};

// The images that the scores are taken from: one row per view, estimate (after the gain) left, truth right.
struct HeldOutViews {
  std::vector<cv::Mat> estimates, truths;            // 8-bit BGR; estimates before the gain
  std::vector<cv::Mat> estimate_masks, truth_masks;  // uint8
  std::vector<cv::Mat> unobserved_masks;             // uint8; where the truth is drawn and no sensor saw it
};

// centre: of the wearer, world frame. unobserved: of each triangle of the truth, whether no sensor saw it; empty: all
// of it was seen.
HeldOutViews held_out_views(Renderer& renderer, const TexturedMesh& estimate, const TexturedMesh& truth,
                            const Vector3d& centre, const std::vector<bool>& unobserved = {});
HeldOutScores compare_views(const HeldOutViews& views);

}  // namespace dressform
