#pragma once
#include <string>
#include <vector>

#include "eval/figures/figure_list.h"

namespace dressform {

constexpr int kFigureHeightPx = 900;  // of one view of a mesh: 300 dpi at the tallest row

// Pictures of what a stage made of a garment, from one side of the mannequin (degrees about the vertical, 0: as the
// first sensor looks, 90: from its left). Empty where it made none of it.
cv::Mat closed_picture(const FigureInput& input, const std::string& slot, double azimuth_deg);
cv::Mat opened_picture(const FigureInput& input, const std::string& slot, double azimuth_deg, bool boundaries);
cv::Mat textured_picture(const FigureInput& input, const std::string& slot, double azimuth_deg);
cv::Mat rough_picture(const FigureInput& input, const std::string& slot, double azimuth_deg);
cv::Mat support_picture(const FigureInput& input, const std::string& slot, double azimuth_deg);
// Points of the model frame, coloured or not.
cv::Mat cloud_picture(const FigureInput& input, const PointCloud& cloud, double azimuth_deg);
cv::Mat body_picture(const FigureInput& input, const Mesh& body, double heading_rad, double azimuth_deg);

// One view of items that are already turned. Empty for nothing.
cv::Mat one_view(Renderer& renderer, const std::vector<RenderItem>& items, double azimuth_deg);

}  // namespace dressform
