#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "eval/gate/bytes.h"
#include "eval/gate/golden_case.h"
#include "eval/gate/golden_run.h"
#include "eval/gate/nuisance.h"

namespace dressform {

enum class GateVerdict { pass, regression, obsolete };

// What came of one thing that was compared.
enum class ItemVerdict {
  same,     // the very number, the very pixels
  within,   // nuisance
  better,   // beyond nuisance in the good direction, or a known miss that is met: to accept
  worse,    // beyond nuisance, another status, or a target newly missed
  creep,    // small steps that were accepted one by one have come too far
  gone,     // no longer measured or made
  unknown,  // the reference does not know it: obsolete
};
const char* verdict_word(ItemVerdict verdict);
bool is_failure(ItemVerdict verdict);  // worse, creep, gone, unknown

// One number, picture or target.
struct GateItem {
  std::string stage;  // which it judges: "registration", ..., or "image"
  std::string name;   // "max/rotation_deg@1", "result_user", "max/rotation_deg@1 (target)"
  ItemVerdict verdict = ItemVerdict::same;
  std::string message;  // reference, new, difference and tolerance; empty where it is the same
  double times = 0;     // how many tolerances it is off; infinite for what has no number
  // As `accept --item` and known misses call it: "surface top/f_5mm@1", "image result_user".
  std::string what() const { return stage + " " + name; }
};

// One target of the run.
struct GateTarget {
  std::string metric;     // "surface top/f_5mm@1"
  std::string value;      // "0.963"
  std::string target;     // ">= 0.85"
  double from_scale = 0;  // resolution from which it is meant to hold
  bool met = false;
  std::string known;  // of a miss that the reference knows: why
};

// What came of the items of one stage.
struct StageVerdict {
  std::string stage;
  ItemVerdict verdict = ItemVerdict::same;  // the worst of its items
  double times = 0;                         // of the worst failure
  std::map<ItemVerdict, int> counts;
};

struct GateResult {
  GateVerdict verdict = GateVerdict::pass;
  BytesResult bytes;
  std::vector<GateItem> items;       // all, in the order of the scores, then targets, then pictures
  std::vector<GateItem> findings;    // those that failed, worst first
  std::vector<GateItem> better;      // beyond tolerance in the good direction, most first: to accept
  std::vector<StageVerdict> stages;  // worst first, then in the order of the pipeline
  std::vector<GateTarget> targets;
  // Where it began: in the same environment by bytes; else the first stage of the pipeline of which a number or picture
  // failed. Empty where nothing changed, or nothing failed.
  std::string blame;
  int compared = 0;
  std::vector<std::string> unmeasured;  // metrics whose nuisance is declared and not measured
};

// Compares a run with its reference: bytes first, then numbers, targets and pictures. A number that is worse beyond its
// nuisance, another status, a number that went missing, a picture that differs, and a missed target that the reference
// does not know are regressions; numbers or images that the reference does not know make it obsolete. In the same
// environment bytes name the stage to blame; what passes and what fails is told by numbers and pictures alone.
GateResult compare_with_golden(const GoldenCase& golden, const GoldenRun& run, const MeasuredNuisance& nuisance = {});

// The first stage, in the order of the pipeline, of which a finding failed; pictures last; empty for none.
std::string first_failing_stage(const std::vector<GateItem>& findings);

// How far nuisance (compiler, instruction set, platform) may move this number, by the declaration of its metric. Throws
// std::logic_error for a row that nobody declared.
double nuisance_tolerance(const ScoreRow& row);

// How much worse `to` is than `from`, in the metric's unit, by the direction that it declares; negative where it is
// better. Any change of a number without direction is its worsening.
double worsening(const ScoreRow& row, double from, double to);

// A number that has come further from its first accept, step by step, than this many tolerances beyond what was
// accepted knowingly is an alarm: three steps, each just too small to be seen, and one more.
constexpr double kCreepTolerances = 3;

}  // namespace dressform
