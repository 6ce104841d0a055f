#pragma once
#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace dressform::metrics {

// Peak signal-to-noise ratio in dB of 8-bit images over the pixels of a mask (all channels); infinite where they are
// equal, NaN on an empty mask.
double psnr_db(const cv::Mat& a, const cv::Mat& b, const cv::Mat& mask);

// SSIM (Wang et al., 2004) of the luma (0.299 R + 0.587 G + 0.114 B) of 8-bit BGR images: 11 x 11 Gaussian window of
// sigma 1.5, K = (.01, .03), range 255, no downsampling. One value per window that lies wholly inside the image: the
// map is 10 pixels smaller either way, and (x, y) of it belongs to the window centred on (x + 5, y + 5).
cv::Mat ssim_map(const cv::Mat& a, const cv::Mat& b);
// Mean over the windows whose centre lies in the mask (of the images' size); NaN without any.
double masked_ssim(const cv::Mat& a, const cv::Mat& b, const cv::Mat& mask);

// Colour difference CIEDE2000 of two L*a*b* colours (Sharma, Wu, Dalal, 2005; kL = kC = kH = 1).
double ciede2000(const std::array<double, 3>& lab1, const std::array<double, 3>& lab2);
// CIE L*a*b* (D65) of an sRGB colour, 0 to 255 each.
std::array<double, 3> lab_of_srgb(double red, double green, double blue);
// The differences at the mask's pixels of 8-bit BGR images, row by row.
std::vector<double> color_differences(const cv::Mat& a, const cv::Mat& b, const cv::Mat& mask);

// Linear gain per channel (B, G, R) that gives the estimate the mean linear intensity of the truth over the masks'
// pixels of all views; 1 where nothing tells. Absolute exposure and white balance of a capture cannot be observed.
cv::Vec3d gain_to_match(const std::vector<cv::Mat>& estimates, const std::vector<cv::Mat>& truths,
                        const std::vector<cv::Mat>& masks);
// An 8-bit sRGB image after a gain in linear light.
cv::Mat with_gain(const cv::Mat& image, const cv::Vec3d& gain);

}  // namespace dressform::metrics
