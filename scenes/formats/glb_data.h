#pragma once
#include <tiny_gltf.h>

#include <string>
#include <vector>

#include "scenes/error.h"

namespace dressform {

// Looks at a GLB's JSON before the library does. Throws InputError naming the file: too short, nested too deep, or an
// extension that the file requires and the reader does not know, by name.
void check_glb_json(const std::string& where, const std::string& bytes);

// The numbers of a glTF file: accessors with their bounds checked.
class GlbData {
 public:
  GlbData(std::string where, const tinygltf::Model& model) : where_(std::move(where)), model_(model) {}

  // All components of all elements in a row; normalised whole numbers as fractions, sparse values put in. `type`:
  // what the accessor must hold (TINYGLTF_TYPE_VEC3, ...). Throws InputError naming the file.
  std::vector<double> numbers(int accessor, int type) const;
  // How many elements an accessor has.
  std::size_t count(int accessor) const;

  template <class T>
  const T& at(const std::vector<T>& list, int index, const char* what) const {
    if (index < 0 || index >= static_cast<int>(list.size()))
      fail(std::string("names ") + what + " " + std::to_string(index) + "; expected one that the file has");
    return list[index];
  }
  [[noreturn]] void fail(const std::string& problem) const { throw InputError(where_, problem); }
  const tinygltf::Model& model() const { return model_; }

 private:
  struct Block {
    const unsigned char* bytes;
    std::size_t stride;
  };
  Block block(int view, std::size_t offset, std::size_t stride, std::size_t element, std::size_t count) const;
  void put_sparse(const tinygltf::Accessor& accessor, int components, std::vector<double>& numbers) const;

  std::string where_;
  const tinygltf::Model& model_;
};

}  // namespace dressform
