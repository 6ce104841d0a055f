// Tables of the thesis as Markdown, CSV, LaTeX and HTML.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "eval/report/csv.h"
#include "eval/report/html.h"
#include "eval/report/thesis_tables.h"

namespace dressform {
namespace {

std::string latex(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (std::string("&%$#_{}").find(c) != std::string::npos)
      result += std::string("\\") + c;
    else if (c == '\\')
      result += "\\textbackslash{}";
    else if (c == '~' || c == '^')
      result += std::string("\\") + c + "{}";
    else
      result += c;
  }
  return result;
}

// siunitx aligns numbers at their points; everything else of such a column stands in braces.
std::string latex_number(const std::string& text) {
  const bool number = !text.empty() && text.find_first_not_of("0123456789.-+") == std::string::npos &&
                      text.find_first_of("0123456789") != std::string::npos;
  return number ? text : "{" + latex(text) + "}";
}

std::string markdown(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '|' ? "\\|" : std::string(1, c);
  return result;
}

// The column heads: names, then every measure of the run with the thesis's beside it.
std::vector<std::string> heads(const ThesisTable& table) {
  std::vector<std::string> all = table.columns;
  if (!table.rows.empty())
    for (const auto& figure : table.rows.front().figures) {
      all.push_back(figure.measure);
      all.push_back("thesis");
    }
  return all;
}

std::vector<std::string> cells(const ThesisTable::Row& row) {
  std::vector<std::string> all = row.names;
  for (const auto& figure : row.figures) {
    all.push_back(figure.value);
    all.push_back(figure.thesis);
  }
  return all;
}

template <class Escape>
std::string joined(const std::vector<std::string>& parts, const char* between, const Escape& escape) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) text += (i ? between : "") + escape(parts[i]);
  return text;
}

}  // namespace

std::string tables_markdown(const std::vector<ThesisTable>& tables) {
  std::string text;
  for (const auto& table : tables) {
    const auto names = heads(table);
    text += fmt::format("{}Table {}: {}\n\n| {} |\n|", text.empty() ? "" : "\n", table.number, table.caption,
                        joined(names, " | ", markdown));
    for (std::size_t i = 0; i < names.size(); ++i) text += i < table.columns.size() ? "---|" : "---:|";
    text += "\n";
    for (const auto& row : table.rows) text += "| " + joined(cells(row), " | ", markdown) + " |\n";
    for (const auto& note : table.notes) text += "\n" + markdown(note) + "\n";
  }
  return text;
}

std::string tables_csv(const std::vector<ThesisTable>& tables) {
  std::string text = "table,run,what,measure,value,thesis,reason\n";
  for (const auto& table : tables)
    for (const auto& row : table.rows) {
      const std::vector<std::string> what(row.names.begin() + 1, row.names.end());
      for (const auto& figure : row.figures) {
        const std::vector<std::string> fields{std::to_string(table.number),
                                              row.names.front(),
                                              fmt::format("{}", fmt::join(what, " / ")),
                                              figure.measure,
                                              figure.value,
                                              figure.thesis,
                                              figure.reason};
        text += joined(fields, ",", csv_field) + "\n";
      }
    }
  return text;
}

std::string tables_latex(const std::vector<ThesisTable>& tables) {
  std::string text = "% \\usepackage{booktabs,siunitx}\n";
  for (const auto& table : tables) {
    const std::size_t names = table.columns.size();
    const auto line = [&](const std::vector<std::string>& fields) {
      std::string joined_fields;
      for (std::size_t i = 0; i < fields.size(); ++i)
        joined_fields += (i ? " & " : "") + (i < names ? latex(fields[i]) : latex_number(fields[i]));
      return joined_fields + " \\\\\n";
    };
    const auto columns = heads(table);
    text += fmt::format(
        "\n\\begin{{table}}\n\\centering\n\\caption{{{} (table {} of the thesis)}}\n\\begin{{tabular}}{{{}{}}}\n"
        "\\toprule\n{}\\midrule\n",
        latex(table.caption), table.number, std::string(names, 'l'), std::string(columns.size() - names, 'S'),
        line(columns));
    for (const auto& row : table.rows) text += line(cells(row));
    text += "\\bottomrule\n\\end{tabular}\n";
    for (const auto& note : table.notes) text += "\n\\smallskip\\footnotesize " + latex(note) + "\n";
    text += "\\end{table}\n";
  }
  return text;
}

std::string tables_html(const std::vector<ThesisTable>& tables) {
  HtmlPage page("Tables of the thesis");
  for (const auto& table : tables) {
    page.heading(fmt::format("Table {}: {}", table.number, table.caption), fmt::format("table{}", table.number));
    std::vector<std::vector<HtmlPage::Cell>> rows;
    for (const auto& row : table.rows) {
      rows.emplace_back();
      for (const auto& text : cells(row)) rows.back().push_back({text, text == "-" ? "quiet" : ""});
    }
    page.table(heads(table), rows);
    for (const auto& note : table.notes) page.paragraph(note);
  }
  return page.text();
}

}  // namespace dressform
