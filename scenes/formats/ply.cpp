#include "scenes/formats/ply.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>

#include "scenes/error.h"
#include "scenes/file_bytes.h"
#include "scenes/formats/file_mesh.h"

namespace dressform {
namespace {

enum class Type { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };
enum class Format { kAscii, kLittle, kBig };

struct PropertyHeader {
  std::string name;
  bool list = false;
  Type count_type = Type::kUint8, type = Type::kFloat;
};
struct ElementHeader {
  std::string name;
  std::size_t count = 0;
  std::vector<PropertyHeader> properties;
};
struct Header {
  Format format = Format::kAscii;
  std::vector<std::string> comments;
  std::vector<ElementHeader> elements;
  std::size_t size = 0;  // bytes up to the data
};

std::size_t size_of(Type type) {
  switch (type) {
    case Type::kInt8:
    case Type::kUint8:
      return 1;
    case Type::kInt16:
    case Type::kUint16:
      return 2;
    case Type::kDouble:
      return 8;
    default:
      return 4;
  }
}

double full_scale_of(Type type) {
  switch (type) {
    case Type::kInt8:
      return 127;
    case Type::kUint8:
      return 255;
    case Type::kInt16:
      return 32767;
    case Type::kUint16:
      return 65535;
    default:
      return 1;
  }
}

Type type_named(const std::string& where, const std::string& name) {
  static const std::map<std::string, Type> types{
      {"char", Type::kInt8},     {"int8", Type::kInt8},     {"uchar", Type::kUint8},   {"uint8", Type::kUint8},
      {"short", Type::kInt16},   {"int16", Type::kInt16},   {"int", Type::kInt32},     {"int32", Type::kInt32},
      {"ushort", Type::kUint16}, {"uint16", Type::kUint16}, {"uint", Type::kUint32},   {"uint32", Type::kUint32},
      {"float", Type::kFloat},   {"float32", Type::kFloat}, {"double", Type::kDouble}, {"float64", Type::kDouble}};
  const auto found = types.find(name);
  if (found == types.end()) throw InputError(where, "found the property type \"" + name + "\"; expected one of PLY's");
  return found->second;
}

class HeaderReader {
 public:
  HeaderReader(std::string where, const std::string& bytes) : where_(std::move(where)), bytes_(bytes) {}

  Header read() {
    if (next_line() != "ply") throw InputError(where_, "does not start with \"ply\"; expected a PLY file");
    while (true) {
      const std::string line = next_line();
      if (line == "end_header") break;
      read_line(line);
    }
    header_.size = at_;
    return header_;
  }

 private:
  std::string next_line() {
    const std::size_t end = bytes_.find('\n', at_);
    if (end == std::string::npos) throw InputError(where_, "the header does not end; expected end_header");
    std::string line = bytes_.substr(at_, end - at_);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    at_ = end + 1;
    return line;
  }

  void read_line(const std::string& line) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if (keyword == "format") {
      read_format(words);
    } else if (keyword == "comment") {
      header_.comments.push_back(line.size() > 8 ? line.substr(8) : "");
    } else if (keyword == "element") {
      read_element(words, line);
    } else if (keyword == "property") {
      read_property(words, line);
    } else if (keyword != "obj_info" && !keyword.empty()) {
      throw InputError(where_, "found \"" + line.substr(0, 60) + "\" in the header; expected a PLY keyword");
    }
  }

  void read_format(std::istringstream& words) {
    std::string name;
    words >> name;
    if (name == "ascii")
      header_.format = Format::kAscii;
    else if (name == "binary_little_endian")
      header_.format = Format::kLittle;
    else if (name == "binary_big_endian")
      header_.format = Format::kBig;
    else
      throw InputError(where_, "found the format \"" + name + "\"; expected ascii or binary");
  }

  void read_element(std::istringstream& words, const std::string& line) {
    ElementHeader element;
    long long count = -1;
    if (!(words >> element.name >> count) || count < 0)
      throw InputError(where_, "found \"" + line.substr(0, 60) + "\"; expected an element's name and count");
    element.count = static_cast<std::size_t>(count);
    header_.elements.push_back(element);
  }

  void read_property(std::istringstream& words, const std::string& line) {
    PropertyHeader property;
    std::string type;
    words >> type;
    property.list = type == "list";
    if (property.list) {
      std::string count_type;
      words >> count_type >> type;
      property.count_type = type_named(where_, count_type);
    }
    property.type = type_named(where_, type);
    if (!(words >> property.name) || header_.elements.empty())
      throw InputError(where_, "found \"" + line.substr(0, 60) + "\"; expected a named property of an element");
    header_.elements.back().properties.push_back(property);
  }

  std::string where_;
  const std::string& bytes_;
  std::size_t at_ = 0;
  Header header_;
};

// Reads the numbers of the data section one after the other.
class DataReader {
 public:
  DataReader(std::string where, const std::string& bytes, const Header& header)
      : where_(std::move(where)),
        format_(header.format),
        at_(bytes.data() + header.size),
        end_(bytes.data() + bytes.size()) {}

  // Throws unless `count` things of at least `size` bytes (binary) or a digit and a space (ASCII) are left.
  void require(std::size_t count, std::size_t size) const {
    const std::size_t least = format_ == Format::kAscii ? 2 : size;
    if (least && count > (static_cast<std::size_t>(end_ - at_) + 1) / least) truncated();
  }

  double next(Type type) { return format_ == Format::kAscii ? next_text() : next_binary(type); }

 private:
  [[noreturn]] void truncated() const { throw InputError(where_, "the data end early; expected as many as announced"); }

  double next_text() {
    while (at_ < end_ && (*at_ == ' ' || *at_ == '\n' || *at_ == '\r' || *at_ == '\t')) ++at_;
    if (at_ == end_) truncated();
    if (*at_ == '+') ++at_;
    double value = 0;
    const auto [stop, error] = std::from_chars(at_, end_, value);
    if (error != std::errc{} && error != std::errc::result_out_of_range) {
      const std::string word(at_, std::min(end_, at_ + 20));
      throw InputError(where_, "found \"" + word.substr(0, word.find_first_of(" \r\n\t")) + "\"; expected a number");
    }
    at_ = stop;
    return value;
  }

  template <class T>
  double value_at(const char* bytes) const {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
  }

  double next_binary(Type type) {
    const std::size_t size = size_of(type);
    if (static_cast<std::size_t>(end_ - at_) < size) truncated();
    char bytes[8];
    std::memcpy(bytes, at_, size);
    if (format_ == Format::kBig) std::reverse(bytes, bytes + size);
    at_ += size;
    switch (type) {
      case Type::kInt8:
        return value_at<std::int8_t>(bytes);
      case Type::kUint8:
        return value_at<std::uint8_t>(bytes);
      case Type::kInt16:
        return value_at<std::int16_t>(bytes);
      case Type::kUint16:
        return value_at<std::uint16_t>(bytes);
      case Type::kInt32:
        return value_at<std::int32_t>(bytes);
      case Type::kUint32:
        return value_at<std::uint32_t>(bytes);
      case Type::kFloat:
        return value_at<float>(bytes);
      case Type::kDouble:
        return value_at<double>(bytes);
    }
    return 0;
  }

  std::string where_;
  Format format_;
  const char *at_, *end_;
};

void read_list(const std::string& where, DataReader& data, const PropertyHeader& header, PlyProperty& property) {
  const double count = data.next(header.count_type);
  if (!(count >= 0 && count < 1e9)) throw InputError(where, "found a list of impossible length; expected a count");
  data.require(static_cast<std::size_t>(count), size_of(header.type));
  for (double i = 0; i < count; ++i) property.values.push_back(data.next(header.type));
  property.starts.push_back(property.values.size());
}

PlyElement read_element(const std::string& where, DataReader& data, const ElementHeader& header) {
  PlyElement element;
  element.name = header.name;
  element.count = header.count;
  std::size_t least = 0;
  for (const auto& property : header.properties) {
    element.properties.push_back({property.name, {}, {}, full_scale_of(property.type)});
    if (property.list) element.properties.back().starts.push_back(0);
    least += size_of(property.list ? property.count_type : property.type);
  }
  if (header.properties.empty()) return element;
  data.require(header.count, least);
  for (std::size_t i = 0; i < header.count; ++i)
    for (std::size_t p = 0; p < header.properties.size(); ++p)
      if (header.properties[p].list)
        read_list(where, data, header.properties[p], element.properties[p]);
      else
        element.properties[p].values.push_back(data.next(header.properties[p].type));
  return element;
}

}  // namespace

const PlyProperty* PlyElement::find(const std::string& property) const {
  for (const auto& each : properties)
    if (each.name == property) return &each;
  return nullptr;
}

const PlyElement* PlyFile::find(const std::string& element) const {
  for (const auto& each : elements)
    if (each.name == element) return &each;
  return nullptr;
}

PlyFile read_ply_file(const std::filesystem::path& path) {
  const std::string where = path.string(), bytes = read_file_bytes(path, kMostMeshBytes);
  const Header header = HeaderReader(where, bytes).read();
  DataReader data(where, bytes, header);
  PlyFile file;
  file.comments = header.comments;
  for (const auto& element : header.elements) file.elements.push_back(read_element(where, data, element));
  return file;
}

}  // namespace dressform
