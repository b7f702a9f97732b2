// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/observer_statistics/mixed.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/answer_tables/choice.h"
#include "analysis/answer_tables/levels.h"
#include "analysis/output/text_output.h"
#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

using Term = std::vector<std::string>;

std::string nameOf(const Term& term) { return join(term, ":"); }

/// "a:b" into a and b, unless a column has that very name.
Term parseTerm(const std::string& text, const MixedRows& rows) {
  if (rows.columns.count(text) > 0) return {text};
  Term out;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(':', begin), text.size());
    out.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  std::vector<std::string> known;
  for (const auto& [name, values] : rows.columns) known.push_back(name);
  for (const std::string& name : out) {
    placeOf(name, known, "column", "--fixed");
    if (std::count(out.begin(), out.end(), name) > 1)
      throw Error("'" + text + "' has '" + name + "' twice", "--fixed");
  }
  return out;
}

std::vector<Term> parseTerms(const MixedRows& rows, const MixedTerms& terms) {
  std::vector<Term> out;
  std::set<std::set<std::string>> known;
  for (const std::string& text : terms.fixed) {
    out.push_back(parseTerm(text, rows));
    if (!known.insert({out.back().begin(), out.back().end()}).second)
      throw Error("'" + text + "' is named twice", "--fixed");
  }
  for (const Term& term : out)
    for (const std::string& without : term) {
      if (term.size() == 1) continue;
      std::set<std::string> rest(term.begin(), term.end());
      rest.erase(without);
      if (known.count(rest) == 0)
        throw Error("the interaction '" + nameOf(term) + "' has no '" + nameOf({rest.begin(), rest.end()}) +
                        "' beside it",
                    "--fixed", "name it too: without it the interaction would have another meaning");
    }
  return out;
}

/// Puts the level at `place` first.
void putFirst(Levels& levels, size_t place) {
  const auto found = levels.names.begin() + static_cast<std::ptrdiff_t>(place);
  std::rotate(levels.names.begin(), found, found + 1);
  for (size_t& level : levels.ofRow) level = level == place ? 0 : level + (level < place ? 1 : 0);
}

/// The levels of a column, the reference first, and the level of each row.
Levels levelsOf(const MixedRows& rows, const std::string& name, const std::string& reference) {
  Levels levels = levelsIn(rows.columns.at(name));
  if (levels.names.size() < 2)
    throw Error("column '" + name + "' has one level, '" + levels.names[0] + "'", "--fixed", "leave it out");
  std::vector<std::string> first;
  if (const auto known = rows.levels.find(name); known != rows.levels.end()) first = known->second;
  if (!reference.empty()) {
    if (std::count(levels.names.begin(), levels.names.end(), reference) == 0)
      throw Error("column '" + name + "' has no level '" + reference + "'", "--reference",
                  suggest(reference, levels.names));
    first.insert(first.begin(), reference);
  }
  for (size_t i = first.size(); i-- > 0;) {
    const auto found = std::find(levels.names.begin(), levels.names.end(), first[i]);
    if (found != levels.names.end()) putFirst(levels, static_cast<size_t>(found - levels.names.begin()));
  }
  return levels;
}

/// A column of the data as columns of the design.
struct Coded {
  ModelColumn source;
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;
};

Coded codeNumbers(const MixedRows& rows, const std::string& name, std::vector<double> values,
                  bool logarithmic, bool centred) {
  Coded out;
  out.source = {name, true, logarithmic, centred, 0.0, {}};
  for (size_t row = 0; logarithmic && row < values.size(); ++row) {
    if (!(values[row] > 0.0))
      throw Error("'" + rows.columns.at(name)[row] + "' has no logarithm", rows.place(row, name),
                  "--log takes numbers above 0");
    values[row] = std::log(values[row]);
  }
  if (centred) {
    for (const double value : values) out.source.centre += value / static_cast<double>(values.size());
    for (double& value : values) value -= out.source.centre;
  }
  if (std::all_of(values.begin(), values.end(), [&](double value) { return value == values[0]; }))
    throw Error("column '" + name + "' is the same in all rows", "--fixed", "leave it out");
  out.names = {logarithmic ? "ln(" + name + ")" : name};
  out.columns = {std::move(values)};
  return out;
}

Coded codeLevels(const std::string& name, const Levels& levels) {
  Coded out;
  out.source = {name, false, false, false, 0.0, levels.names};
  for (size_t level = 1; level < levels.names.size(); ++level) {
    out.names.push_back(name + "=" + levels.names[level]);
    out.columns.emplace_back();
    for (const size_t own : levels.ofRow) out.columns.back().push_back(own == level ? 1.0 : 0.0);
  }
  return out;
}

bool names(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

Coded code(const MixedRows& rows, const std::string& name, const MixedTerms& terms,
           const std::map<std::string, std::string>& references) {
  const std::vector<std::string>& values = rows.columns.at(name);
  std::vector<double> numbers;
  size_t text = values.size();
  for (size_t row = 0; row < values.size(); ++row) {
    if (values[row].empty()) throw Error("is empty", rows.place(row, name), "every row needs its value");
    if (const auto number = finiteNumber(values[row]))
      numbers.push_back(*number);
    else
      text = row;
  }
  const bool forced = names(terms.categorical, name);
  if (text < values.size() && !numbers.empty() && !forced)
    throw Error("'" + values[text] + "' is no number, other rows have numbers", rows.place(text, name),
                "fix it, or take the column as names of levels with --categorical " + name);
  const bool numeric = numbers.size() == values.size() && !forced;
  const auto reference = references.find(name);
  if (numeric) {
    if (reference != references.end())
      throw Error("column '" + name + "' holds numbers and has no reference", "--reference",
                  "take them as names of levels with --categorical " + name);
    return codeNumbers(rows, name, numbers, names(terms.log, name), names(terms.centre, name));
  }
  for (const auto& [list, option] : {std::pair(&terms.log, "--log"), std::pair(&terms.centre, "--center")})
    if (names(*list, name)) throw Error("column '" + name + "' does not hold numbers", option);
  return codeLevels(name, levelsOf(rows, name, reference == references.end() ? "" : reference->second));
}

/// All products of a column of each, the last varying fastest.
Coded multiply(const Coded& a, const Coded& b) {
  Coded out;
  for (size_t i = 0; i < a.names.size(); ++i)
    for (size_t j = 0; j < b.names.size(); ++j) {
      out.names.push_back(a.names[i] + ":" + b.names[j]);
      out.columns.push_back(a.columns[i]);
      for (size_t row = 0; row < out.columns.back().size(); ++row)
        out.columns.back()[row] *= b.columns[j][row];
    }
  return out;
}

/// Every column that an option names takes part in the model.
void requireUsed(const std::vector<std::string>& list, const std::set<std::string>& used,
                 const std::string& option) {
  for (const std::string& name : list)
    if (used.count(name) == 0)
      throw Error("column '" + name + "' is not in the model", option,
                  suggest(name, {used.begin(), used.end()}));
}

std::map<std::string, std::string> parseReferences(const std::vector<std::string>& texts,
                                                   const std::set<std::string>& used) {
  std::map<std::string, std::string> out;
  for (const std::string& text : texts) {
    const auto [column, level] = splitAssignment(text, "names no level", "--reference", "write COLUMN=LEVEL");
    requireUsed({column}, used, "--reference");
    out[column] = level;
  }
  return out;
}

}  // namespace

MixedDesign buildDesign(const MixedRows& rows, const MixedTerms& terms) {
  if (terms.fixed.empty())
    throw Error("no effect is named", "--fixed", "give columns and interactions: --fixed a,b,a:b");
  const std::vector<Term> parsed = parseTerms(rows, terms);
  std::set<std::string> used;
  for (const Term& term : parsed) used.insert(term.begin(), term.end());
  requireUsed(terms.categorical, used, "--categorical");
  requireUsed(terms.log, used, "--log");
  requireUsed(terms.centre, used, "--center");
  if (!terms.slope.empty()) requireUsed({terms.slope}, used, "--slope");
  const auto references = parseReferences(terms.references, used);

  MixedDesign out;
  std::map<std::string, Coded> coded;
  for (const Term& term : parsed)
    if (term.size() == 1) {
      coded[term[0]] = code(rows, term[0], terms, references);
      out.sources.push_back(coded[term[0]].source);
    }
  for (const Term& term : parsed) {
    Coded product = coded.at(term[0]);
    for (size_t i = 1; i < term.size(); ++i) product = multiply(product, coded.at(term[i]));
    if (term == Term{terms.slope}) {
      if (product.names.size() != 1)
        throw Error("'" + terms.slope + "' has more than two levels, which no single slope tells apart",
                    "--slope", "take a column of numbers or of two levels");
      out.slope = out.names.size();
    }
    out.names.insert(out.names.end(), product.names.begin(), product.names.end());
    out.columns.insert(out.columns.end(), product.columns.begin(), product.columns.end());
  }
  return out;
}

}  // namespace limen::analysis
