#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace dressform {

// A run's folder and its run.json: what was asked, on what machine, what each stage cost, and which files were made
// from what, so that a second run makes only what is missing, damaged or out of date.
class RunFolder {
 public:
  // Throws InputError when `folder` is a file, or holds other things than a run. Writes nothing.
  static void check(const std::filesystem::path& folder);

  // Checks, then opens or creates the folder. One process at a time writes into it: throws InputError while another
  // one does.
  explicit RunFolder(std::filesystem::path folder);

  const std::filesystem::path& path() const { return folder_; }

  // Makes a product unless the one that is there was made from the same `identity` and all its files are intact.
  // `make` returns the files it wrote, relative to the folder. True when it was made now.
  bool product(const std::string& name, const std::string& identity,
               const std::function<std::vector<std::string>()>& make);

  // Hash over the files of a product made earlier in this run.
  std::string product_hash(const std::string& name) const;

  // Facts for run.json; `save` writes it.
  nlohmann::json& facts() { return facts_; }
  void save() const;

 private:
  bool intact(const std::string& name, const std::string& identity) const;
  std::filesystem::path folder_;
  std::shared_ptr<int> lock_;  // descriptor of the folder, locked as long as this lives
  nlohmann::json facts_, products_;
};

// Version, commit, compiler and flags, processor, thread count: the provenance part of run.json.
nlohmann::json provenance(int threads);

}  // namespace dressform
