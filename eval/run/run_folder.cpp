#include "eval/run/run_folder.h"

#include <chrono>
#include <fstream>

#include "pipeline/run/artifact_store.h"
#include "scenes/error.h"
#include "scenes/file_bytes.h"
#include "scenes/hash.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json read_json_if_intact(const fs::path& file) {
  std::ifstream in(file);
  return in ? json::parse(in, nullptr, false) : json();
}

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown";
}

}  // namespace

void RunFolder::check(const fs::path& folder) {
  if (fs::exists(folder) && !fs::is_directory(folder))
    throw InputError("-o " + folder.string(), "is a file; expected a folder for the run");
  if (fs::exists(folder) && !fs::is_empty(folder) && !fs::exists(folder / "run.json"))
    throw InputError("-o " + folder.string(), "is not empty and holds no run.json; expected a new folder or a run's");
}

RunFolder::RunFolder(fs::path folder) : folder_(std::move(folder)), facts_(json::object()), products_(json::object()) {
  check(folder_);
  const bool used = fs::exists(folder_ / "run.json");
  const json old = read_json_if_intact(folder_ / "run.json");
  if (old.is_object() && old.contains("products") && old["products"].is_object()) products_ = old["products"];
  if (!used) save();
}

bool RunFolder::intact(const std::string& name, const std::string& identity) const {
  try {
    const json& product = products_.at(name);
    if (product.at("identity") != identity) return false;
    for (const auto& [file, hash] : product.at("files").items())
      if (!fs::exists(folder_ / file) || hash_file(folder_ / file) != hash) return false;
    return true;
  } catch (const json::exception&) {
    return false;
  }
}

bool RunFolder::product(const std::string& name, const std::string& identity,
                        const std::function<std::vector<std::string>()>& make) {
  if (intact(name, identity)) return false;
  const auto start = std::chrono::steady_clock::now();
  reset_peak_memory();
  json files = json::object();
  for (const auto& file : make()) files[file] = hash_file(folder_ / file);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  products_[name] = {
      {"identity", identity}, {"files", files}, {"seconds", seconds.count()}, {"peak_memory_mb", peak_memory_mb()}};
  save();
  return true;
}

std::string RunFolder::product_hash(const std::string& name) const {
  return hash_hex(products_.at(name).at("files").dump());
}

void RunFolder::save() const {
  json text = facts_;
  text["format"] = "dressform-run";
  text["version"] = 1;
  text["products"] = products_;
  fs::create_directories(folder_);
  write_file_atomically(folder_ / "run.json", text.dump(1) + "\n");
}

json provenance(int threads) {
  return {{"dressform", DRESSFORM_VERSION}, {"commit", code_version("commit")}, {"compiler", DRESSFORM_COMPILER},
          {"flags", DRESSFORM_FLAGS},       {"processor", processor_name()},    {"threads", threads}};
}

}  // namespace dressform
