#include "scenes/image_file.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "scenes/error.h"

namespace dressform {

const ImageKind kDepthImage{CV_16UC1, "16-bit grey"}, kIndexImage{CV_8UC1, "8-bit grey"},
    kColorImage{CV_8UC3, "8-bit colour without transparency"},
    kColorOrGreyImage{CV_8UC3, "8-bit colour or grey without transparency", true};

namespace {

using Bytes = std::vector<unsigned char>;

// The bytes of an image, wherever they are kept.
struct View {
  const unsigned char* data;
  std::size_t size;
  const unsigned char& operator[](std::size_t i) const { return data[i]; }
};

// What a PNG's header says.
struct PngHeader {
  std::uint32_t width, height;
  int bits, color;
};

Bytes read_bytes(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))  // a pipe would wait for ever
    throw InputError(file.string(), "is missing; expected an image");
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (!stream) throw InputError(file.string(), "cannot be read; expected a readable image");
  Bytes bytes(static_cast<std::size_t>(stream.tellg()));
  stream.seekg(0);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return bytes;
}

std::uint32_t big_endian(const unsigned char* at) {
  return std::uint32_t(at[0]) << 24 | std::uint32_t(at[1]) << 16 | std::uint32_t(at[2]) << 8 | at[3];
}

// CRC-32 of PNG (ISO 3309), eight bytes a step.
std::uint32_t crc32(const unsigned char* data, std::size_t size) {
  static const auto tables = [] {
    std::array<std::array<std::uint32_t, 256>, 8> t{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t value = i;
      for (int bit = 0; bit < 8; ++bit) value = value & 1 ? 0xEDB88320u ^ (value >> 1) : value >> 1;
      t[0][i] = value;
    }
    for (int k = 1; k < 8; ++k)
      for (int i = 0; i < 256; ++i) t[k][i] = t[0][t[k - 1][i] & 255] ^ (t[k - 1][i] >> 8);
    return t;
  }();
  std::uint32_t crc = 0xFFFFFFFFu;
  for (; size >= 8; size -= 8, data += 8) {
    const std::uint32_t low = crc ^ (data[0] | data[1] << 8 | data[2] << 16 | std::uint32_t(data[3]) << 24);
    crc = tables[7][low & 255] ^ tables[6][low >> 8 & 255] ^ tables[5][low >> 16 & 255] ^ tables[4][low >> 24] ^
          tables[3][data[4]] ^ tables[2][data[5]] ^ tables[1][data[6]] ^ tables[0][data[7]];
  }
  for (; size; --size, ++data) crc = tables[0][(crc ^ *data) & 255] ^ (crc >> 8);
  return ~crc;
}

bool is_png(const View& bytes) {
  static const unsigned char magic[8] = {0x89, 'P', 'N', 'G', 13, 10, 26, 10};
  return bytes.size >= 8 && std::memcmp(bytes.data, magic, 8) == 0;
}

bool is_jpeg(const View& bytes) { return bytes.size >= 3 && bytes[0] == 0xFF && bytes[1] == 0xD8 && bytes[2] == 0xFF; }

// Walks the chunks of a PNG. The decoder would print damage on the terminal and return half an image.
PngHeader checked_png(const std::string& where, const View& bytes) {
  const auto damaged = [&] { throw InputError(where, "is damaged; expected a whole PNG"); };
  PngHeader header{};
  std::size_t at = 8;
  bool ended = false;
  while (!ended) {
    if (at + 12 > bytes.size) damaged();
    const std::size_t length = big_endian(&bytes[at]);
    if (length > bytes.size - at - 12) damaged();
    if (crc32(&bytes[at + 4], length + 4) != big_endian(&bytes[at + 8 + length])) damaged();
    if (at == 8) {
      if (std::memcmp(&bytes[12], "IHDR", 4) != 0 || length != 13) damaged();
      header = {big_endian(&bytes[16]), big_endian(&bytes[20]), bytes[24], bytes[25]};
    }
    ended = std::memcmp(&bytes[at + 4], "IEND", 4) == 0;
    at += length + 12;
  }
  return header;
}

void check_png_kind(const std::string& where, const PngHeader& header, const ImageKind& kind) {
  const bool right = header.bits == (CV_MAT_DEPTH(kind.type) == CV_16U ? 16 : 8) &&
                     (header.color == (kind.type == CV_8UC3 ? 2 : 0) || (header.color == 0 && kind.grey_too));
  static const char* colors[] = {
      "grey", "?", "colour", "palette", "grey with transparency", "?", "colour with transparency"};
  if (!right)
    throw InputError(where, "found " + std::to_string(header.bits) + "-bit " +
                                colors[header.color < 7 ? header.color : 1] + "; expected " + kind.name);
}

// A JPEG cut short decodes to grey below the cut: look for its end mark (some writers pad after it).
void check_jpeg(const std::string& where, const View& bytes) {
  const std::size_t first = bytes.size > 1024 ? bytes.size - 1024 : 2;
  for (std::size_t i = first; i + 1 < bytes.size; ++i)
    if (bytes[i] == 0xFF && bytes[i + 1] == 0xD9) return;
  throw InputError(where, "is damaged; expected a whole JPEG");
}

// Columns and rows of a JPEG, of its frame header; 0 x 0 where there is none.
cv::Size jpeg_size(const View& bytes) {
  for (std::size_t at = 2; at + 9 < bytes.size && bytes[at] == 0xFF;) {
    const int mark = bytes[at + 1];
    if (mark == 0xFF) {  // padding
      ++at;
      continue;
    }
    const bool is_frame = mark >= 0xC0 && mark <= 0xCF && mark != 0xC4 && mark != 0xC8 && mark != 0xCC;
    if (is_frame) return {bytes[at + 7] << 8 | bytes[at + 8], bytes[at + 5] << 8 | bytes[at + 6]};
    at += 2 + (static_cast<std::size_t>(bytes[at + 2]) << 8 | bytes[at + 3]);
  }
  return {};
}

cv::Mat decoded(const std::string& where, const View& bytes) {
  cv::Mat image;
  try {
    image = cv::imdecode(cv::Mat(1, static_cast<int>(bytes.size), CV_8U, const_cast<unsigned char*>(bytes.data)),
                         cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
  }
  if (image.empty()) throw InputError(where, "is damaged; expected an image");
  return image;
}

void check_image_size(const std::string& where, double width, double height) {
  constexpr double kMostSide = 16384, kMostPixels = 1 << 27;
  if (width < 1 || height < 1 || width > kMostSide || height > kMostSide || width * height > kMostPixels)
    throw InputError(where, "found an image of " + std::to_string(static_cast<long long>(width)) + " x " +
                                std::to_string(static_cast<long long>(height)) +
                                " pixels; expected 1 to 16384 a side and 134217728 in all");
}

}  // namespace

cv::Mat read_image(const std::filesystem::path& file, const ImageKind& kind, cv::Size size) {
  const Bytes read = read_bytes(file);
  const View bytes{read.data(), read.size()};
  const std::string where = file.string();
  if (is_png(bytes)) {
    const PngHeader header = checked_png(where, bytes);
    check_png_kind(where, header, kind);
    check_image_size(where, header.width, header.height);
  } else if (is_jpeg(bytes)) {
    if (kind.type != CV_8UC3) throw InputError(where, "found a JPEG; expected a PNG of " + std::string(kind.name));
    check_jpeg(where, bytes);
    const cv::Size size_in_header = jpeg_size(bytes);
    check_image_size(where, size_in_header.width, size_in_header.height);
  } else {
    throw InputError(
        where, std::string("found no PNG") + (kind.type == CV_8UC3 ? " or JPEG" : "") + "; expected " + kind.name);
  }
  cv::Mat image = decoded(where, bytes);
  if (kind.grey_too && image.type() == CV_8UC1) cv::cvtColor(image, image, cv::COLOR_GRAY2BGR);
  if (image.type() != kind.type)
    throw InputError(file.string(), "found " + std::to_string(image.channels()) + " channels of " +
                                        std::to_string(8 * image.elemSize1()) + " bits; expected " + kind.name);
  if (size.area() > 0 && image.size() != size)
    throw InputError(file.string(), "found " + std::to_string(image.cols) + " x " + std::to_string(image.rows) +
                                        " pixels; expected " + std::to_string(size.width) + " x " +
                                        std::to_string(size.height));
  return image;
}

cv::Mat TextureImage::brightness() const {
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

TextureImage decode_texture(const std::string& where, const std::string& text) {
  const View bytes{reinterpret_cast<const unsigned char*>(text.data()), text.size()};
  if (is_png(bytes)) {
    const PngHeader header = checked_png(where, bytes);
    check_image_size(where, header.width, header.height);
  } else if (is_jpeg(bytes)) {
    check_jpeg(where, bytes);
    const cv::Size size = jpeg_size(bytes);
    check_image_size(where, size.width, size.height);
  } else {
    throw InputError(where, "not a readable image; expected a PNG or JPEG");
  }
  cv::Mat image = decoded(where, bytes);
  if (image.depth() == CV_16U) image.convertTo(image, CV_8U, 1 / 257.0);
  if (image.depth() != CV_8U) throw InputError(where, "found an image of floating-point pixels; expected 8 or 16 bits");
  TextureImage result;
  if (image.channels() == 4) {
    cv::extractChannel(image, result.alpha, 3);
    if (cv::countNonZero(result.alpha != 255) == 0) result.alpha.release();
    cv::cvtColor(image, result.bgr, cv::COLOR_BGRA2BGR);
  } else if (image.channels() == 1) {
    cv::cvtColor(image, result.bgr, cv::COLOR_GRAY2BGR);
  } else {
    result.bgr = image;
  }
  return result;
}

void write_png(const std::filesystem::path& file, const cv::Mat& image) {
  Bytes bytes;
  cv::imencode(".png", image, bytes, {cv::IMWRITE_PNG_COMPRESSION, 1});
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!stream.flush()) throw InputError(file.string(), "cannot be written; expected a writable folder");
}

}  // namespace dressform
