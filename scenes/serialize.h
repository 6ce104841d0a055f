#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cereal/cereal.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/map.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/set.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/variant.hpp>
#include <cstring>
#include <opencv2/core/mat.hpp>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace dressform {

// Binary archives for whatever has a member `serialize(Archive&)`: the same value gives the same bytes. Numbers and
// fixed-size Eigen types are kept as in memory (little-endian), containers as a 64-bit count and their elements.
// Reading checks every count against the bytes that are left before anything is allocated.

class ByteWriter : public cereal::OutputArchive<ByteWriter, cereal::AllowEmptyClassElision> {
 public:
  ByteWriter() : OutputArchive(this) {}
  void write(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class ByteReader : public cereal::InputArchive<ByteReader, cereal::AllowEmptyClassElision> {
 public:
  explicit ByteReader(const std::string& bytes) : InputArchive(this), at_(bytes.data()), end_(at_ + bytes.size()) {}
  std::size_t left() const { return end_ - at_; }
  // Throws std::runtime_error unless `count` things of `size` bytes are left.
  void require(std::uint64_t count, std::size_t size) const {
    if (size && count > left() / size) throw std::runtime_error("serialized data are truncated or damaged");
  }
  void read(void* data, std::size_t size) {
    require(size, 1);
    if (size) std::memcpy(data, at_, size);
    at_ += size;
  }

 private:
  const char *at_, *end_;
};

template <class T>
std::string to_bytes(const T& value) {
  ByteWriter writer;
  writer(value);
  return writer.take();
}

// Throws std::runtime_error for data that are truncated, too long or otherwise not what to_bytes<T> makes.
template <class T>
T from_bytes(const std::string& bytes) {
  ByteReader reader(bytes);
  T value{};
  reader(value);
  if (reader.left()) throw std::runtime_error("serialized data are longer than expected");
  return value;
}

namespace serialize_detail {

// Types whose bytes in memory are their value, with no padding: they are written as they are, alone and in vectors.
template <class T, class = void>
struct IsRaw : std::integral_constant<bool, std::is_arithmetic_v<T> && !std::is_same_v<T, bool>> {};
template <class S, int R, int C, int O, int MR, int MC>
struct IsRaw<Eigen::Matrix<S, R, C, O, MR, MC>> : std::integral_constant<bool, IsRaw<S>::value && (R > 0) && (C > 0)> {
};
template <class S, int D, int M, int O>
struct IsRaw<Eigen::Transform<S, D, M, O>> : IsRaw<typename Eigen::Transform<S, D, M, O>::MatrixType> {};
template <class S, int O>
struct IsRaw<Eigen::Quaternion<S, O>> : IsRaw<S> {};
template <class T, std::size_t N>
struct IsRaw<std::array<T, N>> : IsRaw<T> {};

template <class T>
inline constexpr bool kIsEigen = IsRaw<T>::value && !std::is_arithmetic_v<T>;

// Least bytes that an element of a vector takes: what a count is checked against.
template <class T>
inline constexpr std::size_t kLeastBytes = IsRaw<T>::value ? sizeof(T) : (std::is_empty_v<T> ? 0 : 1);

}  // namespace serialize_detail
}  // namespace dressform

CEREAL_SETUP_ARCHIVE_TRAITS(dressform::ByteReader, dressform::ByteWriter)

namespace cereal {

template <class T, traits::EnableIf<std::is_arithmetic<T>::value> = traits::sfinae>
void CEREAL_SAVE_FUNCTION_NAME(dressform::ByteWriter& writer, const T& value) {
  writer.write(&value, sizeof value);
}
template <class T, traits::EnableIf<std::is_arithmetic<T>::value> = traits::sfinae>
void CEREAL_LOAD_FUNCTION_NAME(dressform::ByteReader& reader, T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    unsigned char byte = 0;
    reader.read(&byte, 1);
    if (byte > 1) throw std::runtime_error("serialized data are damaged: a truth value is neither 0 nor 1");
    value = byte;
  } else {
    reader.read(&value, sizeof value);
  }
}

template <class T>
void CEREAL_SAVE_FUNCTION_NAME(dressform::ByteWriter& writer, const BinaryData<T>& block) {
  writer.write(block.data, block.size);
}
template <class T>
void CEREAL_LOAD_FUNCTION_NAME(dressform::ByteReader& reader, BinaryData<T>& block) {
  reader.read(block.data, block.size);
}

template <class T>
void CEREAL_SERIALIZE_FUNCTION_NAME(dressform::ByteWriter& writer, SizeTag<T>& tag) {
  const std::uint64_t count = tag.size;
  writer(count);
}
template <class T>
void CEREAL_SERIALIZE_FUNCTION_NAME(dressform::ByteReader& reader, SizeTag<T>& tag) {
  std::uint64_t count = 0;
  reader(count);
  reader.require(count, 1);
  tag.size = count;
}

template <class T>
void CEREAL_SERIALIZE_FUNCTION_NAME(dressform::ByteWriter& writer, NameValuePair<T>& pair) {
  writer(pair.value);
}
template <class T>
void CEREAL_SERIALIZE_FUNCTION_NAME(dressform::ByteReader& reader, NameValuePair<T>& pair) {
  reader(pair.value);
}

template <class S, int R, int C, int O, int MR, int MC>
void CEREAL_SAVE_FUNCTION_NAME(dressform::ByteWriter& writer, const Eigen::Matrix<S, R, C, O, MR, MC>& matrix) {
  if constexpr (R < 0 || C < 0)
    writer(static_cast<std::int64_t>(matrix.rows()), static_cast<std::int64_t>(matrix.cols()));
  writer.write(matrix.data(), matrix.size() * sizeof(S));
}
template <class S, int R, int C, int O, int MR, int MC>
void CEREAL_LOAD_FUNCTION_NAME(dressform::ByteReader& reader, Eigen::Matrix<S, R, C, O, MR, MC>& matrix) {
  if constexpr (R < 0 || C < 0) {
    std::int64_t rows = 0, cols = 0;
    reader(rows, cols);
    if (rows < 0 || cols < 0 || (R > 0 && rows != R) || (C > 0 && cols != C))
      throw std::runtime_error("serialized data are damaged: a matrix of impossible size");
    reader.require(rows, sizeof(S));
    reader.require(cols, sizeof(S));
    if (rows > 0) reader.require(cols, rows * sizeof(S));
    matrix.resize(rows, cols);
  }
  reader.read(matrix.data(), matrix.size() * sizeof(S));
}

template <class S, int D, int M, int O>
void CEREAL_SAVE_FUNCTION_NAME(dressform::ByteWriter& writer, const Eigen::Transform<S, D, M, O>& motion) {
  writer(motion.matrix());
}
template <class S, int D, int M, int O>
void CEREAL_LOAD_FUNCTION_NAME(dressform::ByteReader& reader, Eigen::Transform<S, D, M, O>& motion) {
  reader(motion.matrix());
}

template <class T, class A>
void CEREAL_SAVE_FUNCTION_NAME(dressform::ByteWriter& writer, const std::vector<T, A>& vector) {
  writer(make_size_tag(static_cast<size_type>(vector.size())));
  if constexpr (dressform::serialize_detail::IsRaw<T>::value)
    writer.write(vector.data(), vector.size() * sizeof(T));
  else
    for (const auto& each : vector) writer(static_cast<const T&>(each));
}
template <class T, class A>
void CEREAL_LOAD_FUNCTION_NAME(dressform::ByteReader& reader, std::vector<T, A>& vector) {
  size_type count = 0;
  reader(make_size_tag(count));
  reader.require(count, dressform::serialize_detail::kLeastBytes<T>);
  vector.clear();
  if constexpr (dressform::serialize_detail::IsRaw<T>::value) {
    vector.resize(count);
    reader.read(vector.data(), count * sizeof(T));
  } else {
    for (size_type i = 0; i < count; ++i) {  // one by one: a false count runs out of data, not of memory
      T each{};
      reader(each);
      vector.push_back(std::move(each));
    }
  }
}

// Two-dimensional images of any depth and number of channels.
inline void CEREAL_SAVE_FUNCTION_NAME(dressform::ByteWriter& writer, const cv::Mat& image) {
  if (image.dims > 2) throw std::invalid_argument("to_bytes: an image of more than two dimensions");
  writer(image.type(), image.rows, image.cols);
  for (int y = 0; y < image.rows; ++y) writer.write(image.ptr(y), image.cols * image.elemSize());
}
inline void CEREAL_LOAD_FUNCTION_NAME(dressform::ByteReader& reader, cv::Mat& image) {
  int type = 0, rows = 0, cols = 0;
  reader(type, rows, cols);
  if (type < 0 || (type & ~CV_MAT_TYPE_MASK) || rows < 0 || cols < 0 || (rows == 0) != (cols == 0))
    throw std::runtime_error("serialized data are damaged: an image of impossible type or size");
  image = cv::Mat();
  if (rows == 0) return;
  reader.require(static_cast<std::uint64_t>(rows) * cols, CV_ELEM_SIZE(type));
  image.create(rows, cols, type);
  for (int y = 0; y < rows; ++y) reader.read(image.ptr(y), cols * image.elemSize());
}

}  // namespace cereal
