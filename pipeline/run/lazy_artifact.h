#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace dressform {

// A value that stages pass on: known by the hash of its content, and only brought into memory when a stage that has to
// run asks for it. Not thread safe.
template <class T>
class LazyArtifact {
 public:
  LazyArtifact(std::string content_hash, std::function<T()> bring)
      : content_hash_(std::move(content_hash)), slot_(std::make_shared<Slot>()) {
    slot_->bring = std::move(bring);
  }
  const std::string& content_hash() const { return content_hash_; }
  const T& get() const {
    if (!slot_->value) slot_->value = slot_->bring();
    return *slot_->value;
  }
  void keep(T value) const { slot_->value = std::move(value); }

 private:
  struct Slot {
    std::function<T()> bring;
    std::optional<T> value;
  };
  std::string content_hash_;
  std::shared_ptr<Slot> slot_;
};

}  // namespace dressform
