#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

namespace dressform {

// The closed curve round the body that parts top from bottom: one height for every direction.
// nats: float32, one column per direction (the last joins the first), rows upwards; positive speaks for top.
// Returns for every column the first row that is top (0 .. rows), minimising the nats on the wrong side plus
// row_price for every row that neighbouring columns differ by. Dynamic programming, twice round.
std::vector<int> trace_hem(const cv::Mat& nats, double row_price);

// A hem lies in a plane but for a few rows: nats with `sure` added for top above and taken off below that band about
// the plane through the curve (a level one tilted, fitted by least absolute distances).
cv::Mat near_plane(const cv::Mat& nats, const std::vector<int>& curve, int band_rows, float sure);

}  // namespace dressform
