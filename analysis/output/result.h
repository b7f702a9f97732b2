// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "analysis/statistics/interval.h"

namespace limen::analysis {

// What an analysis found, as tables of typed columns. Every command and every section of a study's page
// builds one; renderers (result_text.h, result_data.h, the page writer) print it. Names are the same in JSON
// and CSV:
//
//     estimate, low, high   what was estimated and its interval; with several estimates in a row each has its
//     own
//                           name and NAME_low, NAME_high (d_prime, d_prime_low, d_prime_high)
//     level                 confidence level of the intervals, 0 to 1
//     standard_error, sd, p, p_holm (adjusted after Holm), bootstrap_low, bootstrap_high
//     df, df_error, z, t, f, n, trials, observers, seed, samples
//     part, group, condition, observer, predictor   what a row is about

/// How a column's values are printed for people. JSON and CSV have full precision.
enum class Kind {
  Text,
  List,  ///< of texts
  Flag,
  Integer,
  Number,
  Significant,    ///< number, by significant digits
  Share,          ///< 0 to 1, in per cent for people
  Probability,    ///< p: "< 0.0001"
  Count,          ///< so many of so many: "3/8"
  Interval,       ///< "0.1 to 0.3"; "-" for one of no width, which comes of data without spread
  ShareInterval,  ///< the same in per cent
  Rounded,        ///< number to four digits, whole ones in full
  Html,           ///< for pages alone: a text that is HTML already
};

/// `number` of `of`.
struct CountOf {
  int64_t number = 0, of = 0;
};

/// A value, or none. Numbers that are not finite are printed as inf and -inf for people, as none elsewhere.
class ResultCell {
 public:
  using Value = std::variant<std::monostate, std::string, std::vector<std::string>, bool, int64_t, double,
                             CountOf, Interval>;

  // Out of line: many are made, and GCC 12 warns of inlined moves of such a variant.
  ResultCell();
  ~ResultCell();
  ResultCell(const ResultCell& other);
  ResultCell(ResultCell&& other) noexcept;
  ResultCell& operator=(const ResultCell& other);
  ResultCell& operator=(ResultCell&& other) noexcept;
  ResultCell(const char* text);
  ResultCell(std::string text);
  ResultCell(std::vector<std::string> texts);
  ResultCell(CountOf count);
  ResultCell(Interval interval);
  ResultCell(bool value);
  ResultCell(int64_t value);
  ResultCell(double value);
  template <class T, class = std::enable_if_t<std::is_integral_v<T>>>
  ResultCell(T value) : ResultCell(static_cast<int64_t>(value)) {}
  template <class T>
  ResultCell(const std::optional<T>& value) : ResultCell() {
    if (value) *this = ResultCell(*value);
  }

  bool empty() const { return std::holds_alternative<std::monostate>(value_); }
  const Value& value() const { return value_; }

 private:
  Value value_;
};

struct Column {
  enum class Audience { Everybody, People, Data };

  std::string name;    ///< in JSON and CSV; "" for People
  std::string second;  ///< of the second value of a Count or an Interval
  std::string title;   ///< for people
  Kind kind = Kind::Text;
  int digits = 3;
  Audience audience = Audience::Everybody;
  bool optional = false;    ///< left out for people where no cell has a value
  bool identifies = false;  ///< a fact that stands in each of a section's rows of CSV
  std::vector<ResultCell> cells;

  bool isNumber() const {
    return kind != Kind::Text && kind != Kind::List && kind != Kind::Flag && kind != Kind::Html;
  }
  bool shownToPeople() const;
};

// Columns. A title that is left out is the name with blanks for underscores.
Column text(const std::string& name, const std::string& title = {});
Column list(const std::string& name, const std::string& title = {});
Column flag(const std::string& name, const std::string& title = {});
Column integer(const std::string& name, const std::string& title = {});
Column number(const std::string& name, const std::string& title = {}, int digits = 3);
Column significant(const std::string& name, const std::string& title = {}, int digits = 4);
Column rounded(const std::string& name, const std::string& title = {});
Column html(const std::string& title);
Column share(const std::string& name, const std::string& title = {});
Column probability(const std::string& name = "p", const std::string& title = {});
Column count(const std::string& number, const std::string& of, const std::string& title = {});
/// low and high, or NAME_low and NAME_high.
Column interval(const std::string& name = {}, const std::string& title = "95 %", int digits = 3);
Column shareInterval(const std::string& name = {}, const std::string& title = "95 %");

Column forData(Column column);    ///< JSON and CSV only
Column forPeople(Column column);  ///< text and HTML only
Column ifAny(Column column);      ///< left out for people if it is empty
Column key(Column column);        ///< says which section a row of CSV belongs to

/// What members lead to one after the other, also through pointers and optionals: at(&Row::fit, &Fit::aic).
/// None where one of those is empty.
template <class Value>
ResultCell reach(const Value& value) {
  return ResultCell(value);
}
template <class Value, class Member, class... Rest>
ResultCell reach(const Value& value, Member member, Rest... rest) {
  if constexpr (requires { *value; })
    return value ? reach(*value, member, rest...) : ResultCell();
  else
    return reach(std::invoke(member, value), rest...);
}
template <class... Members>
auto at(Members... members) {
  return [=](const auto& row) { return reach(row, members...); };
}

/// The same, or none where the condition, a member or a function of the row, is false, 0 or empty.
template <class Condition, class... Members>
auto when(Condition condition, Members... members) {
  return [=](const auto& row) { return std::invoke(condition, row) ? reach(row, members...) : ResultCell(); };
}

/// For columns made by count().
template <class Number, class Of>
auto countOf(Number number, Of of) {
  return [=](const auto& row) {
    return CountOf{static_cast<int64_t>(std::invoke(number, row)),
                   static_cast<int64_t>(std::invoke(of, row))};
  };
}

struct ResultTable {
  std::string name;   ///< in JSON and CSV: "effects"
  std::string title;  ///< a line above it, or ""
  std::vector<Column> columns;

  size_t rows() const { return columns.empty() ? 0 : columns.front().cells.size(); }
};

/// A table with a row for each element: add(column, what is in it), the latter a function or member of the
/// element.
template <class Row>
class TableOf {
 public:
  TableOf(const std::string& name, const std::string& title, const std::vector<Row>& rows) : rows_(rows) {
    table_.name = name;
    table_.title = title;
  }
  template <class Value>
  TableOf& add(Column column, const Value& value) {
    for (const Row& row : rows_) column.cells.push_back(ResultCell(std::invoke(value, row)));
    table_.columns.push_back(std::move(column));
    return *this;
  }
  /// If the elements have it.
  template <class Value>
  TableOf& addIf(bool wanted, Column column, const Value& value) {
    return wanted ? add(std::move(column), value) : *this;
  }
  operator ResultTable() { return std::move(table_); }

 private:
  const std::vector<Row>& rows_;
  ResultTable table_;
};

/// What belongs together: a part of a study, a group of rows. Facts are columns of one cell.
struct Section {
  std::string title;
  std::vector<Column> facts;
  std::vector<ResultTable> tables;
  std::vector<std::string> notes;

  void fact(Column column, ResultCell value);
  /// A table without rows is left out for people.
  void add(ResultTable table) { tables.push_back(std::move(table)); }
  const ResultTable& table(const std::string& name) const;  ///< that there is
};

struct Result {
  std::string command;
  Section head;  ///< what the data are
  std::vector<Section> sections;
  std::vector<std::string> notes;  ///< method, and what dashes mean
};

}  // namespace limen::analysis
