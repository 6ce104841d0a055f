#pragma once
#include <limits>
#include <map>
#include <vector>

#include "pipeline/segment/jseg_growing.h"
#include "pipeline/segment/view_evidence.h"

namespace dressform {

// Mean and standard deviation of colours, CIE L*u*v*, by channel.
struct ColorSpread {
  double weight = 0;
  cv::Vec3d sum{0, 0, 0}, squares{0, 0, 0};

  void add(const cv::Vec3d& luv, double times);
  void add(const ColorSpread& other);
  cv::Vec3d mean() const { return sum * (1 / weight); }
  cv::Vec3d deviation() const;
};
// Distance of the normal distributions (2-Wasserstein), L*u*v* units; lightness counts half, because of shading.
double color_distance(const ColorSpread& a, const ColorSpread& b);

// A region of one view, and what the naked body says of it.
struct RegionFacts {
  std::size_t view = 0;
  int label = 0;  // in the view's map
  double area_mm2 = 0;
  ColorSpread color;                                            // one for each mm^2
  double height_m = std::numeric_limits<double>::quiet_NaN();   // mean, model frame
  double offset_mm = std::numeric_limits<double>::quiet_NaN();  // median, off the naked body
  double unchanged = std::numeric_limits<double>::quiet_NaN();  // part of what the naked shot shows, too
  double exposed = 0;                                           // part on head, hands and feet
  double sleeve = 0, chest = 0;                                 // parts on the upper arms, and above the armpits
  double fringe = 0;                                            // part near a jump of depth or the outline
  std::map<int, double> beside;  // regions that touch it, by index: in its image (pixels), or in space from other views
};

struct FactParams {
  double fringe_px = 2;   // from a jump
  double jump_mm = 50;    // between neighbouring pixels
  double voxel_m = 0.03;  // regions of two views that share one touch
};

// Facts of all views' regions (luv: each view's crop), in the order of views and labels.
std::vector<RegionFacts> region_facts(const std::vector<ViewEvidence>& views, const std::vector<LabelMap>& maps,
                                      const std::vector<cv::Mat>& luv, const Landmarks& limbs,
                                      const FactParams& params);

}  // namespace dressform
