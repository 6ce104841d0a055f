#pragma once
#include <optional>
#include <string>
#include <vector>

namespace dressform {

// Which way a number gets better; neither: it describes, and any change beyond nuisance is worth a look.
enum class Better { lower, higher, near_zero, neither };

// How far another compiler, instruction set, thread count or platform may move a number: absolute + relative times its
// magnitude, in its unit. Says nothing about noise seeds.
struct Nuisance {
  std::string name;
  double absolute = 0, relative = 0;
  double tolerance(double value) const;
};

// A metric, declared once, in the file of eval/score that measures it: the score table, the gate, the tables of
// README.md and eval/README.md and `dressform metrics` read this and nothing else. What stands in <> is filled in by
// each row: "<slot>/f_5mm" gives "top/f_5mm@1" and "bottom/f_5mm@1".
struct Metric {
  Metric(std::string path, int definition_version, std::string in_unit, Better direction, std::string defined_as)
      : name(std::move(path)),
        version(definition_version),
        unit(std::move(in_unit)),
        better(direction),
        definition(std::move(defined_as)) {}

  std::string name;
  int version;       // of the definition: another definition is a new version
  std::string unit;  // "mm", "deg", "1", "count", ...
  Better better;
  std::string definition;  // one or two sentences

  std::optional<double> target;  // the worst value that is good enough
  double from_scale = 0;         // resolution of the cameras (--scale) from which the target is meant to hold
  std::string headline;          // its words in the first score table; empty: it is not in there
  std::string only;              // the one member of the family that target and headline are for ("max"); empty: all
  std::string paper;
  std::optional<Nuisance> own_nuisance;  // where it is not that of the unit
  std::string stage;                     // the family's, set when it registers

  Metric with_target(double bound, double holds_from_scale) const;
  Metric with_headline(const std::string& words) const;
  Metric for_only(const std::string& member) const;
  Metric after(const std::string& source) const;

  // "top/f_5mm@1" of "<slot>/f_5mm" and {"top"}. Throws std::logic_error where the numbers do not fit.
  std::string row_name(const std::vector<std::string>& members) const;
  // What fills the name's <> in a row's name; absent when it is no row of this metric.
  std::optional<std::vector<std::string>> members_of(const std::string& row_name) const;
  // Whether target and headline are for the row with these members.
  bool judges(const std::vector<std::string>& members) const;

  Nuisance nuisance() const;
  bool meets_target(double value) const;
  std::string target_text() const;  // "<= 0.5 deg"; empty without a target
};

// A number as tables show it, with its unit: "0.184 deg", "0.963".
std::string number_text(double value, const std::string& unit);

// All declared metrics, by stage in the order of the pipeline, then as their files declare them.
std::vector<const Metric*> all_metrics();
// The metric that a row belongs to: of several whose pattern fits, the one with the most literal letters. Null for a
// row that nobody declared.
const Metric* find_metric(const std::string& stage, const std::string& row_name);

}  // namespace dressform
