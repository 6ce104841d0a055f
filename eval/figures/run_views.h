#pragma once
#include <string>
#include <vector>

#include "eval/figures/figure_list.h"
#include "scenes/mesh.h"

namespace dressform {

// A registered sensor and the side of the body it sees.
struct RunView {
  std::string sensor, side;  // "front", "left", "back", "right"
};
// In that order; sensors that are not registered have no side and are left out.
std::vector<RunView> run_views(const FigureInput& input);
std::vector<RunView> views_of_sides(const FigureInput& input, const std::vector<std::string>& sides);

// The dressed shot, cut to the dressed mannequin with a little room. Empty where there is no such thing.
cv::Mat dressed_picture(const FigureInput& input, const std::string& sensor);
// The same on white, without what the mask lacks. mask: uint8 at colour size, 0 = left out.
cv::Mat cut_out(const FigureInput& input, const std::string& sensor, const cv::Mat& mask);
// Pixels that segment labels as the garment; those that region filling started from; and its result.
cv::Mat labelled_garment(const FigureInput& input, const std::string& sensor, const std::string& slot);
cv::Mat garment_before_filling(const FigureInput& input, const std::string& sensor, const std::string& slot);
cv::Mat garment_after_filling(const FigureInput& input, const std::string& sensor, const std::string& slot);

// Points of the naked views, or of a garment's filled views, in the model frame; by view in its own colour, or as the
// camera saw them.
PointCloud naked_points(const FigureInput& input, const std::string& only_sensor = "");
PointCloud garment_points(const FigureInput& input, const std::string& slot);

// A mesh as the colour camera of a registered sensor sees it, cut to the dressed mannequin.
cv::Mat seen_by(const FigureInput& input, const std::string& sensor, const std::vector<RenderItem>& items);

}  // namespace dressform
