#pragma once
#include <vector>

#include "scenes/mesh.h"

namespace dressform::metrics {

// A closed line: the last point joins the first.
using ClosedLine = std::vector<Vector3d>;

double closed_length(const ClosedLine& line);

// How far two closed lines lie apart: from points 1 mm apart on each to the other's segments.
struct LineDistance {
  double chamfer_mm = 0;  // mean of both directions' means
  double hd95_mm = 0;     // the larger of both directions' 95th percentiles
};
LineDistance compare_lines(const ClosedLine& estimate, const ClosedLine& truth);

// The estimated loop that belongs to each true rim, -1 for none: the assignment of least total Chamfer distance
// (Kuhn 1955, Munkres 1957).
std::vector<int> match_lines(const std::vector<ClosedLine>& estimate, const std::vector<ClosedLine>& truth);

// Rows of a cost matrix to columns, each column at most once, least total cost; -1 where rows outnumber columns.
std::vector<int> assign(const Eigen::MatrixXd& cost);

// What an unmatched loop counts in chamfer_mm and hd95_mm, and as relative length error.
inline constexpr double kUnmatchedRimMm = 200;

}  // namespace dressform::metrics
