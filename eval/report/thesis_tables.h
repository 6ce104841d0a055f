#pragma once
#include <string>
#include <vector>

#include "eval/report/run_counts.h"

namespace dressform {

// A table of the thesis with the figures of one run or several beside its own.
struct ThesisTable {
  struct Figure {
    std::string measure, value, thesis;  // "-" where there is none
    std::string reason;                  // why "-", where the run can't show it
  };
  struct Row {
    std::vector<std::string> names;  // as `columns`: first the run's
    std::vector<Figure> figures;     // the same measures in every row
  };
  int number = 0;
  std::string caption;
  std::vector<std::string> columns;
  std::vector<Row> rows;
  std::vector<std::string> notes;
};

// Tables 4 to 7 and 9 to 15. Runs of scenes that are none of the thesis's groups ("group1" to "group4") have no figure
// of the thesis beside theirs; runs of a smaller scale have fewer pixels, which a note says.
std::vector<ThesisTable> thesis_tables(const std::vector<RunCounts>& runs);

std::string tables_markdown(const std::vector<ThesisTable>& tables);
std::string tables_csv(const std::vector<ThesisTable>& tables);    // one line for each figure
std::string tables_latex(const std::vector<ThesisTable>& tables);  // for \usepackage{booktabs,siunitx}
std::string tables_html(const std::vector<ThesisTable>& tables);

}  // namespace dressform
