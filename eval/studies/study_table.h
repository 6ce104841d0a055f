#pragma once
#include <string>
#include <vector>

#include "eval/studies/study_results.h"

namespace dressform {

// A study as a paper prints it: a row a variant, a column a metric, means over the scenes that both sides gave a number
// on. The best value is marked where the study supports it, the second best likewise.
struct StudyTable {
  struct Cell {
    std::string text;  // without the unit, which stands in the head; "-" where there is none
    enum class Mark { none, best, second } mark = Mark::none;
    int failed = 0;  // scenes on which the variant gave nothing
  };
  std::string caption;
  std::vector<std::string> heads;  // "surface top/f_5mm@1", "registration max/tre_mm@1 [mm]"
  std::vector<std::string> variants;
  std::vector<std::vector<Cell>> rows;  // [variant][metric]
};

StudyTable study_table(const StudyResults& results, const std::vector<VariantSummary>& summaries);

// Marks of one primary metric by place in `comparisons`, of which the first is the baseline. A place is marked only
// where it is told from the next one: beside the baseline by the verdict, beside another variant by intervals of the
// difference that do not meet. `second` needs a marked best.
std::vector<StudyTable::Cell::Mark> supported_marks(const std::vector<const Comparison*>& comparisons, Better better);

std::string study_table_markdown(const StudyTable& table);  // best **bold**, second <u>underlined</u>
std::string study_table_csv(const StudyTable& table);       // variant,metric,value,mark,failed
std::string study_table_latex(const StudyTable& table);     // for \usepackage{booktabs,siunitx}
std::string study_table_html(const StudyTable& table);

}  // namespace dressform
