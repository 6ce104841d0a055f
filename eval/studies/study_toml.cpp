#include <fmt/format.h>

#include <set>

#include "eval/studies/study.h"
#include "eval/studies/study_variants.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

std::vector<const toml::node*> elements(TomlSection& section, const char* name, const std::string& expected) {
  const toml::node* node = section.find(name);
  if (!node) return {};
  const auto* array = node->as_array();
  if (!array) throw InputError(where_of(*node), fmt::format("{}: expected {}", name, expected));
  std::vector<const toml::node*> result;
  for (const auto& element : *array) result.push_back(&element);
  return result;
}

std::string text_in(const toml::node& node, const char* name) {
  if (!node.is_string()) throw InputError(where_of(node), fmt::format("{}: expected text", name));
  return node.as_string()->get();
}

void read_seeds(TomlSection& section, Study& study) {
  const auto nodes = elements(section, "seeds", "an array of whole numbers, e.g. [1, 2]");
  if (!section.has("seeds")) return;
  std::set<Seed> known;
  study.seeds.clear();
  for (const auto* node : nodes) {
    const auto* whole = node->as_integer();
    if (!whole || whole->get() < 0 || !known.insert(static_cast<Seed>(whole->get())).second)
      throw InputError(where_of(*node), "seeds: expected different whole numbers from 0 on");
    study.seeds.push_back(static_cast<Seed>(whole->get()));
  }
  if (study.seeds.empty()) section.fail("seeds", "found none; expected one at least");
}

void read_drawn(TomlSection& section, Study& study) {
  DrawnRange range;
  fields(section, range.options);
  section("first_seed", range.first_seed, 0, 1000000000, "", "");
  section("count", range.count, 1, 100000, "", "");
  section.texts("strata", range.options.strata);
  study.drawn.push_back(range);
}

void read_scenes(TomlSection& section, Study& study) {
  for (const auto* node : elements(section, "files", "an array of scene files"))
    study.scenes.push_back(fs::absolute(resolved_path(*node, text_in(*node, "files"))));
  for (const auto* node : elements(section, "recordings", "an array of capture sessions (folders)"))
    study.recordings.push_back(
        fs::absolute(resolved_path(*node, text_in(*node, "recordings") + "/session.json")).parent_path());
  section.children("drawn", [&](TomlSection& drawn) { read_drawn(drawn, study); });
  if (study.scenes.empty() && study.recordings.empty() && study.drawn.empty())
    section.fail("", "found no scenes; expected files, recordings or [[scenes.drawn]]");
}

void read_primary(TomlSection& section, Study& study) {
  std::string text;
  section("metric", text, {}, "");
  StudyMetric metric = study_metric(where_of(*section.find("metric")), text);
  metric.primary = true;
  section("margin", metric.margin, 1e-9, 1e9, "", "");
  if (!section.has("margin"))
    section.fail("", fmt::format("found no margin; expected the difference of {} that does not matter, said before "
                                 "anything runs",
                                 text));
  study.metrics.push_back(metric);
}

void read_metrics(TomlSection& section, Study& study) {
  section.children("primary", [&](TomlSection& primary) {
    if (!primary.has("metric")) primary.fail("", "found no metric; expected e.g. metric = \"surface <slot>/f_5mm@1\"");
    read_primary(primary, study);
  });
  if (study.metrics.empty() || study.metrics.size() > kMostPrimary)
    section.fail("primary", fmt::format("found {} primary metrics; expected one to {} [[primary]] tables",
                                        study.metrics.size(), kMostPrimary));
  for (const auto* node : elements(section, "secondary", "an array of metrics"))
    study.metrics.push_back(study_metric(where_of(*node), text_in(*node, "secondary")));
  std::set<std::string> known;
  for (const auto& metric : study.metrics)
    if (!known.insert(metric.text).second) section.fail("", "found the metric " + metric.text + " twice");
}

// [variant.mine]: a table of its own below `variant`, or, where [[variant]] tables went before it, in TOML's eyes below
// the last of these. There it is a variant when it has a command, which no key of a [[variant]] table has.
using NamedTables = std::vector<std::pair<std::string, const toml::node*>>;
NamedTables named_tables(const toml::node& node, bool with_command) {
  NamedTables named;
  const auto* table = node.as_table();
  if (!table) return named;
  for (const auto& [key, value] : *table)
    if (value.is_table() && (!with_command || value.as_table()->contains("command")))
      named.push_back({std::string(key.str()), &value});
  return named;
}

void read_variants(TomlFiles& files, TomlSection& section, Study& study) {
  std::set<std::string> known;
  const auto add = [&](TomlSection& table, const std::string& name) {
    for (const auto& variant : read_study_variants(table, name)) {
      if (!known.insert(variant.name).second)
        table.fail("", "found the variant \"" + variant.name + "\" twice; expected different names");
      study.variants.push_back(variant);
    }
  };
  const auto add_named = [&](const NamedTables& tables) {
    for (const auto& [name, node] : tables) {
      TomlSection table(files, *node, "variant." + name);
      add(table, name);
      table.finish();
    }
  };
  const toml::node* variants = section.find("variant");
  if (variants && variants->is_table()) {
    add_named(named_tables(*variants, false));
  } else {
    std::size_t place = 0;
    section.children("variant", [&](TomlSection& table) {
      const NamedTables named = named_tables((*variants->as_array())[place++], true);
      for (const auto& each : named) table.find(each.first.c_str());
      add(table, "");
      add_named(named);
    });
  }
  if (study.variants.size() < 2)
    section.fail("variant", fmt::format("found {} variants; expected two at least", study.variants.size()));
  study.baseline = study.variants.front().name;
  section("baseline", study.baseline, {}, "");
  if (!known.count(study.baseline))
    section.fail("baseline", fmt::format("found \"{}\"; expected one of {}", study.baseline, fmt::join(known, ", ")));
}

}  // namespace

Study read_study(const fs::path& file) {
  TomlFiles files;
  TomlSection section(files, files.open(file, file.filename().string(), ""), "");
  Study study;
  study.name = file.stem().string();
  section("name", study.name, {}, "");
  section("description", study.description, {}, "");
  section("scale", study.scale, 0.1, 1.0, "", "");
  read_seeds(section, study);
  if (!section.has("scenes")) section.fail("", "found no [scenes]; expected files, recordings or drawn scenes");
  section.child("scenes", [&](TomlSection& scenes) { read_scenes(scenes, study); });
  read_metrics(section, study);
  read_variants(files, section, study);
  section.finish();
  return study;
}

}  // namespace dressform
