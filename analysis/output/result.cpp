// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/output/result.h"

#include <algorithm>
#include <cassert>

namespace limen::analysis {
namespace {

Column column(const std::string& name, const std::string& title, Kind kind, int digits = 3) {
  Column out;
  out.name = name;
  out.title = title;
  if (title.empty()) {
    out.title = name;
    std::replace(out.title.begin(), out.title.end(), '_', ' ');
  }
  out.kind = kind;
  out.digits = digits;
  return out;
}

Column bounds(const std::string& name, const std::string& title, Kind kind, int digits) {
  const std::string prefix = name.empty() ? "" : name + "_";
  Column out = column(prefix + "low", title, kind, digits);
  out.second = prefix + "high";
  return out;
}

}  // namespace

ResultCell::ResultCell() = default;
ResultCell::~ResultCell() = default;
ResultCell::ResultCell(const ResultCell& other) = default;
ResultCell::ResultCell(ResultCell&& other) noexcept = default;
ResultCell& ResultCell::operator=(const ResultCell& other) = default;
ResultCell& ResultCell::operator=(ResultCell&& other) noexcept = default;
ResultCell::ResultCell(const char* text) : value_(std::string(text)) {}
ResultCell::ResultCell(std::string text) : value_(std::move(text)) {}
ResultCell::ResultCell(std::vector<std::string> texts) : value_(std::move(texts)) {}
ResultCell::ResultCell(CountOf count) : value_(count) {}
ResultCell::ResultCell(Interval interval) : value_(interval) {}
ResultCell::ResultCell(bool value) : value_(value) {}
ResultCell::ResultCell(int64_t value) : value_(value) {}
ResultCell::ResultCell(double value) : value_(value) {}

bool Column::shownToPeople() const {
  if (audience == Audience::Data) return false;
  return !optional || std::any_of(cells.begin(), cells.end(), [](const ResultCell& cell) {
    const auto* text = std::get_if<std::string>(&cell.value());
    const auto* texts = std::get_if<std::vector<std::string>>(&cell.value());
    return !cell.empty() && !(text && text->empty()) && !(texts && texts->empty());
  });
}

Column text(const std::string& name, const std::string& title) { return column(name, title, Kind::Text); }
Column list(const std::string& name, const std::string& title) { return column(name, title, Kind::List); }
Column flag(const std::string& name, const std::string& title) { return column(name, title, Kind::Flag); }
Column integer(const std::string& name, const std::string& title) {
  return column(name, title, Kind::Integer);
}
Column number(const std::string& name, const std::string& title, int digits) {
  return column(name, title, Kind::Number, digits);
}
Column significant(const std::string& name, const std::string& title, int digits) {
  return column(name, title, Kind::Significant, digits);
}
Column rounded(const std::string& name, const std::string& title) {
  return column(name, title, Kind::Rounded);
}

Column html(const std::string& title) { return forPeople(column("", title, Kind::Html)); }

Column share(const std::string& name, const std::string& title) { return column(name, title, Kind::Share); }
Column probability(const std::string& name, const std::string& title) {
  return column(name, title, Kind::Probability);
}
Column count(const std::string& number, const std::string& of, const std::string& title) {
  Column out = column(number, title, Kind::Count);
  out.second = of;
  return out;
}
Column interval(const std::string& name, const std::string& title, int digits) {
  return bounds(name, title, Kind::Interval, digits);
}
Column shareInterval(const std::string& name, const std::string& title) {
  return bounds(name, title, Kind::ShareInterval, 1);
}

Column forData(Column column) {
  column.audience = Column::Audience::Data;
  return column;
}
Column forPeople(Column column) {
  column.audience = Column::Audience::People;
  return column;
}
Column ifAny(Column column) {
  column.optional = true;
  return column;
}
Column key(Column column) {
  column.identifies = true;
  return column;
}

void Section::fact(Column column, ResultCell value) {
  column.cells = {std::move(value)};
  facts.push_back(std::move(column));
}

const ResultTable& Section::table(const std::string& name) const {
  const auto found =
      std::find_if(tables.begin(), tables.end(), [&](const ResultTable& one) { return one.name == name; });
  assert(found != tables.end());
  return *found;
}

}  // namespace limen::analysis
