#include "pipeline/run/artifact_store.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "pipeline/run/place_folder.h"
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
    if (record.at("key") != recipe.key()) return {};  // put under another's name by hand
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
  json text = to_json(recipe);
  text["key"] = recipe.key();
  text["content_hash"] = record.content_hash;
  text["size"] = record.size;
  text["seconds"] = seconds;
  text["peak_memory_mb"] = peak_memory_mb;
  place_folder(
      folder(recipe),
      [&](const fs::path& made) {
        write_file_atomically(made / "data.bin", bytes);
        write_file_atomically(made / "artifact.json", text.dump(1) + "\n");
      },
      [&] { return find(recipe).has_value(); });
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
