#include "eval/run/run_facts.h"

#include <nlohmann/json.hpp>

#include "scenes/error.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

template <class T>
std::optional<T> fact(const json& object, const char* name) {
  const auto found = object.find(name);
  if (found == object.end() || found->is_null()) return {};
  return found->get<T>();
}

// What stands in an object below; nothing where it is not there.
json below(const json& object, const char* name) {
  return fact<json::object_t>(object, name).value_or(json::object_t());
}

}  // namespace

RunFacts read_run_facts(const fs::path& run) {
  const fs::path file = run / "run.json";
  RunFacts facts;
  if (!fs::exists(file)) return facts;
  try {
    const json text = json::parse(read_file_bytes(file));
    if (!text.is_object()) throw InputError(file.string(), "is damaged; expected the JSON that a run wrote");
    facts.scene = fact<std::string>(text, "scene");
    facts.variant = fact<std::string>(text, "variant");
    facts.seed = fact<Seed>(text, "seed");
    facts.scale = fact<double>(text, "scale");
    facts.session = fact<std::string>(below(text, "session"), "path").value_or("");
    facts.commit = fact<std::string>(below(text, "provenance"), "commit").value_or("");
    return facts;
  } catch (const json::exception& error) {
    throw InputError(file.string(),
                     std::string("is damaged (") + error.what() + "); expected the JSON that a run wrote");
  }
}

}  // namespace dressform
