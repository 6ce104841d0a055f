#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "scenes/file_bytes.h"
#include "scenes/image_file.h"
#include "scenes/testing/mesh_files.h"

namespace dressform {
namespace {

class TextureImages : public FilesTest {
 protected:
  std::string encoded(const char* extension, const cv::Mat& image) const {
    std::vector<unsigned char> bytes;
    cv::imencode(extension, image, bytes);
    return {bytes.begin(), bytes.end()};
  }
};

TEST_F(TextureImages, AreBroughtToEightBitsOfColour) {
  cv::Mat wide(4, 4, CV_16UC3, cv::Scalar(65535, 32896, 257));
  EXPECT_EQ(decode_texture("a", encoded(".png", wide)).bgr.at<cv::Vec3b>(2, 2), cv::Vec3b(255, 128, 1));
  const TextureImage grey = decode_texture("a", encoded(".png", cv::Mat(4, 4, CV_8UC1, cv::Scalar(77))));
  EXPECT_EQ(grey.bgr.at<cv::Vec3b>(0, 0), cv::Vec3b(77, 77, 77));
  EXPECT_TRUE(grey.alpha.empty());
  const TextureImage opaque = decode_texture("a", encoded(".png", cv::Mat(4, 4, CV_8UC4, cv::Scalar(1, 2, 3, 255))));
  EXPECT_TRUE(opaque.alpha.empty());
  const TextureImage clear =
      decode_texture("a", encoded(".png", cv::Mat(4, 4, CV_16UC4, cv::Scalar(257, 514, 771, 25700))));
  EXPECT_EQ(clear.bgr.at<cv::Vec3b>(3, 3), cv::Vec3b(1, 2, 3));
  EXPECT_EQ(clear.alpha.at<std::uint8_t>(3, 3), 100);
}

TEST_F(TextureImages, GreyWithTransparencyIsRead) {
  // 2 x 1 pixels of grey and alpha, 8 bits: (200, 255) and (100, 0). OpenCV cannot write this kind.
  const unsigned char png[] = {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
                               0x44, 0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x08, 0x04, 0x00, 0x00,
                               0x00, 0x5e, 0x2b, 0xb7, 0x01, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x44, 0x41, 0x54, 0x78,
                               0x9c, 0x63, 0x38, 0xf1, 0x3f, 0x85, 0x01, 0x00, 0x06, 0xea, 0x02, 0x2c, 0x34, 0x25,
                               0x98, 0x48, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  const TextureImage image = decode_texture("a", std::string(reinterpret_cast<const char*>(png), sizeof png));
  EXPECT_EQ(image.bgr.at<cv::Vec3b>(0, 0), cv::Vec3b(200, 200, 200));
  EXPECT_EQ(image.alpha.at<std::uint8_t>(0, 0), 255);
  EXPECT_EQ(image.alpha.at<std::uint8_t>(0, 1), 0);
}

TEST_F(TextureImages, KeepTheirPixelsWhateverTheirOrientationSays) {
  cv::Mat image(16, 32, CV_8UC3, cv::Scalar(0, 0, 0));
  image(cv::Rect(0, 0, 16, 16)).setTo(cv::Scalar(255, 255, 255));
  std::string jpeg = encoded(".jpg", image);
  const char exif[] =
      "\xFF\xE1\x00\x22"
      "Exif\0\0MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0";
  jpeg.insert(2, std::string(exif, 36));
  const TextureImage found = decode_texture("a", jpeg);
  EXPECT_EQ(found.bgr.size(), image.size());
  EXPECT_GT(found.bgr.at<cv::Vec3b>(8, 4)[0], 200);
}

TEST_F(TextureImages, AreRefusedByNameBeforeMemoryIsSpent) {
  std::string huge = encoded(".png", cv::Mat(4, 4, CV_8UC3, cv::Scalar(1, 2, 3)));
  huge.replace(16, 8, std::string("\0\1\0\0\0\1\0\0", 8));  // 65536 x 65536, with the right checksum
  huge.replace(29, 4, std::string("\xe3\xe6\xa7\xb4", 4));
  EXPECT_THAT(refusal([&] { decode_texture("big.png", huge); }),
              testing::HasSubstr("big.png: found an image of 65536 x 65536"));
  std::string jpeg = encoded(".jpg", cv::Mat(64, 64, CV_8UC3, cv::Scalar(1, 2, 3)));
  const std::size_t frame = jpeg.find("\xFF\xC0");
  ASSERT_NE(frame, std::string::npos);
  jpeg.replace(frame + 5, 4, "\xFF\xFF\xFF\xFF");
  EXPECT_THAT(refusal([&] { decode_texture("big.jpg", jpeg); }), testing::HasSubstr("65535 x 65535"));
  EXPECT_THAT(refusal([&] { decode_texture("a.bmp", encoded(".bmp", cv::Mat(4, 4, CV_8UC3))); }),
              testing::HasSubstr("PNG or JPEG"));
  EXPECT_THAT(refusal([&] { decode_texture("a.png", huge.substr(0, 30)); }), testing::HasSubstr("damaged"));
}

}  // namespace
}  // namespace dressform
