#include "eval/studies/foreign_pipeline.h"

#include <fmt/format.h>

#include "eval/run/child_process.h"
#include "eval/run/foreign_run.h"
#include "scenes/hash.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const char* const kPlaceholders = "{session} {out} {seed} {threads} {folder}";
constexpr std::size_t kMostComplaint = 500;  // letters of stderr's end in a cell's reason: one screen's line or five

// The command with its placeholders filled in by `value`. Throws InputError naming `where` for one not known.
template <class Value>
std::string filled_in(const std::string& command, const std::string& where, const Value& value) {
  std::string line;
  for (std::size_t at = 0; at < command.size();) {
    const std::size_t end = command[at] == '{' ? command.find('}', at) : std::string::npos;
    const std::string name = end == std::string::npos ? "" : command.substr(at + 1, end - at - 1);
    const bool plain = name.empty() || name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_") != std::string::npos ||
                       (at > 0 && command[at - 1] == '$');  // ${variable} is the shell's
    if (plain) {
      line += command[at++];
      continue;
    }
    const std::optional<std::string> word = value(name);
    if (!word) throw InputError(where, "command: found {" + name + "}; expected one of " + kPlaceholders);
    line += *word;
    at = end + 1;
  }
  return line;
}

void check_command(const std::string& command, const std::string& where) {
  bool says_out = false;
  filled_in(command, where, [&](const std::string& name) -> std::optional<std::string> {
    says_out = says_out || name == "out";
    if (std::string(kPlaceholders).find("{" + name + "}") == std::string::npos) return {};
    return name;
  });
  if (!says_out)
    throw InputError(where, "command: found no {out}; expected it: the folder that the command leaves its result in");
}

// All of a session but what it is judged by, and what was picked with the truth's help.
void show_session(const fs::path& session, const fs::path& shown) {
  fs::create_directories(shown);
  for (const auto& entry : fs::directory_iterator(fs::absolute(session))) {
    const fs::path name = entry.path().filename();
    if (name != "truth" && name != "picks") fs::create_symlink(entry.path(), shown / name);
  }
}

// One line of printable text, whatever a program printed.
std::string one_line(std::string text) {
  if (text.size() > kMostComplaint) text = "..." + text.substr(text.size() - kMostComplaint);
  std::string line;
  for (const char letter : text)
    line += letter == '\n' ? std::string(" | ") : std::string(1, letter == '\t' ? ' ' : letter);
  const std::string valid = json(line).dump(-1, ' ', false, json::error_handler_t::replace);
  return json::parse(valid).get<std::string>();
}

void check_files(const ForeignPipeline& pipeline) {
  for (const auto& file : pipeline.files)
    if (hash_file(file.path) != file.hash)
      throw InputError(file.path.string(), "changed since the study was planned; expected the same, or a new study");
}

}  // namespace

std::optional<ForeignPipeline> read_foreign_pipeline(TomlSection& section) {
  const toml::node* node = section.find("command");
  ForeignPipeline pipeline;
  section("limit_s", pipeline.limit_s, 1, 1e6, "s", "");
  section("version", pipeline.version, {}, "");
  std::vector<std::string> files;
  section.texts("files", files);
  if (!node) {
    for (const char* key : {"limit_s", "version", "files"})
      if (section.has(key)) section.fail(key, "found it without a command; expected it beside one");
    return {};
  }
  if (!node->is_string()) throw InputError(where_of(*node), "command: expected text");
  pipeline.command = node->as_string()->get();
  check_command(pipeline.command, where_of(*node));
  for (const auto& name : files) {
    const fs::path file = fs::absolute(resolved_path(*section.find("files"), name));
    pipeline.files.push_back({file, hash_file(file)});
  }
  const std::string where = where_of(*node);  // file:line:column
  const std::string file = where.substr(0, where.rfind(':', where.rfind(':') - 1));
  pipeline.folder = fs::absolute(file).parent_path();
  return pipeline;
}

json foreign_json(const ForeignPipeline& pipeline, bool with_paths) {
  json text = {{"command", pipeline.command}, {"limit_s", pipeline.limit_s}, {"version", pipeline.version}};
  json files = json::array();
  for (const auto& file : pipeline.files) {
    json each = {{"hash", file.hash}};
    if (with_paths) each["path"] = file.path.string();
    files.push_back(each);
  }
  text["files"] = files;
  if (with_paths) text["folder"] = pipeline.folder.string();
  return text;
}

ForeignPipeline foreign_from_json(const json& text) {
  ForeignPipeline pipeline;
  pipeline.command = text.at("command");
  pipeline.limit_s = text.at("limit_s");
  pipeline.version = text.at("version");
  for (const auto& file : text.at("files"))
    pipeline.files.push_back({file.at("path").get<std::string>(), file.at("hash")});
  pipeline.folder = text.at("folder").get<std::string>();
  return pipeline;
}

ForeignResult run_foreign_pipeline(const ForeignPipeline& pipeline, const ForeignRequest& request) {
  check_files(pipeline);
  const fs::path work = fs::absolute(request.work), out = work / "out", shown = work / "session";
  fs::create_directories(out);
  show_session(request.session, shown);
  const std::map<std::string, std::string> values{{"session", shell_word(shown.string())},
                                                  {"out", shell_word(out.string())},
                                                  {"seed", std::to_string(request.seed)},
                                                  {"threads", std::to_string(request.threads)},
                                                  {"folder", shell_word(pipeline.folder.string())}};
  const std::string line = filled_in(pipeline.command, "command", [&](const std::string& name) {
    const auto found = values.find(name);
    return found == values.end() ? std::nullopt : std::optional<std::string>(found->second);
  });
  const ChildResult ended =
      run_child({line, work, pipeline.limit_s, work / "command_output.txt", work / "command_log.txt"});
  if (!ended.good())
    throw InputError("command",
                     fmt::format("found {}{}; expected exit code 0 within {:g} s", ended.end_text(),
                                 ended.complaint.empty() ? "" : ": " + one_line(ended.complaint), pipeline.limit_s));
  const ForeignRun run = read_foreign_run(work, request.session);
  return {run.scores, ended.seconds, ended.peak_memory_mb};
}

}  // namespace dressform
