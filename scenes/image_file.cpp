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

Bytes read_bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (!stream || std::filesystem::is_directory(file)) throw InputError(file.string(), "is missing; expected an image");
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

bool is_png(const Bytes& bytes) {
  static const unsigned char magic[8] = {0x89, 'P', 'N', 'G', 13, 10, 26, 10};
  return bytes.size() >= 8 && std::memcmp(bytes.data(), magic, 8) == 0;
}

bool is_jpeg(const Bytes& bytes) {
  return bytes.size() >= 3 && bytes[0] == 0xFF && bytes[1] == 0xD8 && bytes[2] == 0xFF;
}

// Walks the chunks of a PNG. The decoder would print damage on the terminal and return half an image.
void check_png(const std::filesystem::path& file, const Bytes& bytes, const ImageKind& kind) {
  const auto damaged = [&] { throw InputError(file.string(), "is damaged; expected a whole PNG"); };
  std::size_t at = 8;
  bool ended = false;
  while (!ended) {
    if (at + 12 > bytes.size()) damaged();
    const std::size_t length = big_endian(&bytes[at]);
    if (length > bytes.size() - at - 12) damaged();
    if (crc32(&bytes[at + 4], length + 4) != big_endian(&bytes[at + 8 + length])) damaged();
    if (at == 8) {
      if (std::memcmp(&bytes[12], "IHDR", 4) != 0 || length != 13) damaged();
      const int bits = bytes[24], color = bytes[25];
      const bool right = bits == (CV_MAT_DEPTH(kind.type) == CV_16U ? 16 : 8) &&
                         (color == (kind.type == CV_8UC3 ? 2 : 0) || (color == 0 && kind.grey_too));
      static const char* colors[] = {
          "grey", "?", "colour", "palette", "grey with transparency", "?", "colour with transparency"};
      if (!right)
        throw InputError(file.string(), "found " + std::to_string(bits) + "-bit " + colors[color < 7 ? color : 1] +
                                            "; expected " + kind.name);
    }
    ended = std::memcmp(&bytes[at + 4], "IEND", 4) == 0;
    at += length + 12;
  }
}

// A JPEG cut short decodes to grey below the cut: look for its end mark (some writers pad after it).
void check_jpeg(const std::filesystem::path& file, const Bytes& bytes, const ImageKind& kind) {
  if (kind.type != CV_8UC3)
    throw InputError(file.string(), "found a JPEG; expected a PNG of " + std::string(kind.name));
  const std::size_t first = bytes.size() > 1024 ? bytes.size() - 1024 : 2;
  for (std::size_t i = first; i + 1 < bytes.size(); ++i)
    if (bytes[i] == 0xFF && bytes[i + 1] == 0xD9) return;
  throw InputError(file.string(), "is damaged; expected a whole JPEG");
}

}  // namespace

cv::Mat read_image(const std::filesystem::path& file, const ImageKind& kind, cv::Size size) {
  const Bytes bytes = read_bytes(file);
  if (is_png(bytes))
    check_png(file, bytes, kind);
  else if (is_jpeg(bytes))
    check_jpeg(file, bytes, kind);
  else
    throw InputError(file.string(), std::string("found no PNG") + (kind.type == CV_8UC3 ? " or JPEG" : "") +
                                        "; expected " + kind.name);
  cv::Mat image;
  try {
    image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
  }
  if (image.empty()) throw InputError(file.string(), "is damaged; expected an image");
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

void write_png(const std::filesystem::path& file, const cv::Mat& image) {
  Bytes bytes;
  cv::imencode(".png", image, bytes, {cv::IMWRITE_PNG_COMPRESSION, 1});
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!stream.flush()) throw InputError(file.string(), "cannot be written; expected a writable folder");
}

}  // namespace dressform
