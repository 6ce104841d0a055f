#include "pipeline/run/artifact_store.h"

#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "scenes/error.h"
#include "scenes/file_bytes.h"
#include "scenes/hash.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json to_json(const FieldValue& value) {
  return std::visit([](const auto& held) { return json(held); }, value);
}

json to_json(const Recipe& recipe) {
  json values = json::object();
  for (const auto& [name, value] : recipe.values) values[name] = to_json(value);
  return {{"stage", recipe.stage}, {"variant", recipe.variant}, {"code_version", recipe.code_version},
          {"parameters", values},  {"seed", recipe.seed},       {"inputs", recipe.inputs}};
}

fs::path temporary_name(const fs::path& target) {
  return target.parent_path() / ("." + target.filename().string() + "." + std::to_string(::getpid()) + ".tmp");
}

}  // namespace

std::string Recipe::key() const {
  std::ostringstream text;
  text << stage << '\n' << variant << '\n' << code_version << '\n' << seed << '\n';
  for (const auto& [name, value] : values) text << name << '=' << to_text(value) << '\n';
  for (const auto& input : inputs) text << "<- " << input << '\n';
  return hash_hex(text.str());
}

ArtifactStore::ArtifactStore(fs::path root) : root_(fs::absolute(root).lexically_normal()) {}

fs::path ArtifactStore::folder(const Recipe& recipe) const { return root_ / recipe.stage / recipe.key(); }

std::optional<ArtifactRecord> ArtifactStore::find(const Recipe& recipe) const {
  const fs::path at = folder(recipe);
  try {
    if (!fs::exists(at / "artifact.json")) return {};
    const json record = json::parse(read_file_bytes(at / "artifact.json"));
    ArtifactRecord result{recipe, record.at("content_hash"), record.at("size"), record.at("seconds"),
                          record.at("peak_memory_mb")};
    if (fs::file_size(at / "data.bin") != result.size || hash_file(at / "data.bin") != result.content_hash) return {};
    return result;
  } catch (const json::exception&) {  // a damaged record is a damaged artifact: made again
  } catch (const fs::filesystem_error&) {
  } catch (const std::runtime_error&) {
  }
  return {};
}

std::string ArtifactStore::load(const ArtifactRecord& record) const {
  const fs::path file = folder(record.recipe) / "data.bin";
  std::string bytes = read_file_bytes(file);
  if (hash_hex(bytes) != record.content_hash) throw std::runtime_error(file.string() + ": changed while it was in use");
  return bytes;
}

ArtifactRecord ArtifactStore::save(const Recipe& recipe, const std::string& bytes, double seconds,
                                   double peak_memory_mb) {
  const ArtifactRecord record{recipe, hash_hex(bytes), bytes.size(), seconds, peak_memory_mb};
  const fs::path target = folder(recipe), temporary = temporary_name(target);
  fs::create_directories(target.parent_path());
  fs::remove_all(temporary);
  fs::create_directory(temporary);
  json text = to_json(recipe);
  text["key"] = recipe.key();
  text["content_hash"] = record.content_hash;
  text["size"] = record.size;
  text["seconds"] = seconds;
  text["peak_memory_mb"] = peak_memory_mb;
  write_file_atomically(temporary / "data.bin", bytes);
  write_file_atomically(temporary / "artifact.json", text.dump(1) + "\n");
  std::error_code error;
  if (!find(recipe)) {       // else another process was faster, with the same bytes
    fs::remove_all(target);  // a damaged one
    fs::rename(temporary, target, error);
  }
  fs::remove_all(temporary);
  if (error && !find(recipe)) throw fs::filesystem_error("artifact store", temporary, target, error);
  return record;
}

void reset_peak_memory() { std::ofstream("/proc/self/clear_refs") << "5"; }

double peak_memory_mb() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmHWM:", 0) == 0) return std::stod(line.substr(6)) / 1024.0;
  return 0;
}

}  // namespace dressform
