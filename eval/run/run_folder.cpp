#include "eval/run/run_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>

#include "pipeline/run/artifact_store.h"
#include "scenes/error.h"
#include "scenes/file_bytes.h"
#include "scenes/hash.h"
#include "scenes/temporary_files.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json read_json_if_intact(const fs::path& file) {
  std::ifstream in(file);
  return in ? json::parse(in, nullptr, false) : json();
}

// Holds the folder for this process; the system lets go of it when the process ends, however it ends. Where a file
// system knows no locks there is none.
std::shared_ptr<int> locked(const fs::path& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return {};
  std::shared_ptr<int> lock(new int(descriptor), [](int* held) {
    close(*held);
    delete held;
  });
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw InputError("-o " + folder.string(),
                     "another run is writing into this folder; expected a folder of its own for each (they may share a "
                     "store)");
  return lock;
}

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown";
}

}  // namespace

void RunFolder::check(const fs::path& folder) {
  fs::path there = fs::absolute(folder).lexically_normal();  // the nearest folder above that is there takes it
  while (!fs::exists(there) && there.has_relative_path()) there = there.parent_path();
  if (fs::is_directory(there) && access(there.c_str(), W_OK) != 0)
    throw InputError("-o " + folder.string(),
                     there.string() + " cannot be written (" + std::strerror(errno) + "); expected a folder that can");
  if (there != fs::absolute(folder).lexically_normal() && !fs::is_directory(there))
    throw InputError("-o " + folder.string(), there.string() + " is a file; expected a folder to put the run in");
  if (!fs::exists(folder)) return;
  if (!fs::is_directory(folder)) throw InputError("-o " + folder.string(), "is a file; expected a folder for the run");
  // A run that was killed at once may have left half a run.json.
  const bool others = std::any_of(fs::directory_iterator(folder), fs::directory_iterator(), [](const auto& entry) {
    return !is_temporary_name(entry.path().filename().string());
  });
  if (others && !fs::exists(folder / "run.json"))
    throw InputError("-o " + folder.string(), "is not empty and holds no run.json; expected a new folder or a run's");
}

RunFolder::RunFolder(fs::path folder) : folder_(std::move(folder)), facts_(json::object()), products_(json::object()) {
  check(folder_);
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error)
    throw InputError("-o " + folder_.string(), "cannot be made (" + error.message() + "); expected a writable folder");
  lock_ = locked(folder_);
  for (const char* each : {".", "renders"}) remove_stale_temporaries(folder_ / each);
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
