// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/answer_tables/table.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <set>

#include "analysis/output/text_output.h"
#include "experiments/base/error.h"
#include "experiments/base/failure.h"
#include "experiments/base/input_files.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

std::string trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Long junk is cut in messages.
std::string shown(const std::string& text) { return text.size() > 40 ? text.substr(0, 40) + "..." : text; }

/// Reads records one after the other.
class Records {
 public:
  Records(const std::string& text, const std::string& name, char separator)
      : text_(text), name_(name), separator_(separator) {}

  /// False at the end. `line` is where the record begins.
  bool next(std::vector<std::string>& fields, size_t& line) {
    if (at_ >= text_.size()) return false;
    fields.clear();
    line = line_;
    while (true) {
      fields.push_back(field());
      if (at_ < text_.size() && text_[at_] == separator_) {
        ++at_;
        continue;
      }
      if (at_ < text_.size()) ++at_;  // the line feed
      ++line_;
      return true;
    }
  }

 private:
  std::string field() {
    std::string value;
    if (at_ < text_.size() && text_[at_] == '"') {
      const size_t began = line_;
      ++at_;
      while (true) {
        if (at_ >= text_.size())
          throw Error("a quote is not closed", fmt::format("{}:{}", name_, began), "end the field with \"");
        const char c = text_[at_++];
        if (c == '\n') ++line_;
        if (c != '"') {
          value += c;
        } else if (at_ < text_.size() && text_[at_] == '"') {
          value += text_[at_++];
        } else {
          break;
        }
      }
      if (at_ < text_.size() && text_[at_] == '\r') ++at_;
      if (at_ < text_.size() && text_[at_] != separator_ && text_[at_] != '\n')
        throw Error("text follows a closing quote", fmt::format("{}:{}", name_, line_),
                    "write a quote within quotes twice");
      return value;
    }
    while (at_ < text_.size() && text_[at_] != separator_ && text_[at_] != '\n') value += text_[at_++];
    if (!value.empty() && value.back() == '\r' && (at_ >= text_.size() || text_[at_] == '\n'))
      value.pop_back();
    return trimmed(value);
  }

  const std::string& text_;
  const std::string& name_;
  char separator_;
  size_t at_ = 0, line_ = 1;
};

}  // namespace

Table Table::read(const std::string& path, char separator) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (status.type() == std::filesystem::file_type::not_found) throw Error("no such file", path);
  if (!std::filesystem::exists(status)) throw Error(code.message(), path);
  if (std::filesystem::is_directory(status)) throw Error("is a folder, not a table", path);
  protectInput(path);
  return namingFile(path, [&] { return parse(readFileBytes(path), path, separator); });
}

Table Table::parse(const std::string& bytes, const std::string& name, char separator) {
  Table table;
  table.name_ = name;
  const std::string text = bytes.rfind("\xEF\xBB\xBF", 0) == 0 ? bytes.substr(3) : bytes;
  if (text.find('\0') != std::string::npos)
    throw Error("holds zero bytes and is no text", name, "save it as CSV in UTF-8");
  const std::string first = text.substr(0, text.find('\n'));
  if (!separator) separator = first.find('\t') != std::string::npos ? '\t' : ',';
  Records records(text, name, separator);
  std::vector<std::string> fields;
  size_t line = 0;
  const auto blank = [&] { return fields.size() == 1 && fields[0].empty(); };
  while (table.header_.empty() && records.next(fields, line))
    if (!blank()) table.header_ = fields;
  if (table.header_.empty()) throw Error("is empty", name, "the first line names the columns");
  if (table.header_.size() == 1 && table.header_[0].find(';') != std::string::npos)
    throw Error("columns are separated by semicolons", fmt::format("{}:{}", name, line),
                "save it with commas or tabs between columns, and decimal points");
  std::set<std::string> seen;
  for (const std::string& column : table.header_)
    if (!seen.insert(column).second)
      throw Error("two columns are named '" + shown(column) + "'", fmt::format("{}:{}", name, line));
  while (records.next(fields, line)) {
    if (blank()) continue;
    if (fields.size() != table.header_.size())
      throw Error(fmt::format("{} field(s) where the header has {}", fields.size(), table.header_.size()),
                  fmt::format("{}:{}", name, line));
    table.rows_.push_back({line, fields});
  }
  if (table.rows_.empty()) throw Error("has a header and no rows", name);
  return table;
}

size_t Table::column(const std::string& name, const std::string& option) const {
  for (size_t i = 0; i < header_.size(); ++i)
    if (header_[i] == name) return i;
  throw Error("no column '" + shown(name) + "'" + (option.empty() ? "" : " (" + option + ")"), name_,
              suggest(name, header_));
}

std::vector<size_t> Table::columns(const std::vector<std::string>& names, const std::string& option) const {
  std::vector<size_t> out;
  for (const std::string& name : names) out.push_back(column(name, option));
  return out;
}

std::optional<size_t> Table::optionalColumn(const std::string& name, const std::string& option) const {
  return name.empty() ? std::nullopt : std::optional(column(name, option));
}

std::string Table::place(size_t row) const { return fmt::format("{}:{}", name_, rows_[row].line); }

std::string Table::place(size_t row, size_t column) const {
  return fmt::format("{}, column '{}'", place(row), header_[column]);
}

Table Table::only(const std::vector<size_t>& rows) const {
  Table out;
  out.name_ = name_;
  out.header_ = header_;
  for (const size_t row : rows) out.rows_.push_back(rows_[row]);
  return out;
}

double Table::number(size_t row, size_t column) const {
  const std::string& field = text(row, column);
  if (field.empty()) throw Error("is empty", place(row, column), "write a number");
  double value = 0.0;
  const char* begin = field.data() + (field[0] == '+' ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, field.data() + field.size(), value);
  if (error == std::errc::result_out_of_range)
    throw Error("'" + shown(field) + "' is too large or too small for a number", place(row, column));
  if (error != std::errc() || end != field.data() + field.size())
    throw Error("'" + shown(field) + "' is not a number", place(row, column),
                field.find(',') != std::string::npos ? "write a decimal point" : "");
  if (!std::isfinite(value)) throw Error("'" + shown(field) + "' is not a finite number", place(row, column));
  return value;
}

int64_t Table::count(size_t row, size_t column) const {
  const double value = number(row, column);
  if (value < 0.0)
    throw Error("'" + shown(text(row, column)) + "' is negative", place(row, column), "counts start at 0");
  if (value != std::trunc(value))
    throw Error("'" + shown(text(row, column)) + "' is not a whole number", place(row, column));
  if (value > 1e12)
    throw Error("'" + shown(text(row, column)) + "' is too large a count", place(row, column));
  return static_cast<int64_t>(value);
}

}  // namespace limen::analysis
