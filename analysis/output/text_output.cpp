// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/output/text_output.h"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>

#include "experiments/base/error.h"
#include "experiments/base/replace_file.h"

namespace limen::analysis {

std::string escapeHtml(const std::string& text) {
  static const std::string kSpecial = "&<>\"'\n";
  static const char* const kNames[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;", "&#10;"};
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    const size_t place = kSpecial.find(c);
    // Other control letters are not allowed in HTML at all.
    if (place != std::string::npos)
      out += kNames[place];
    else if (static_cast<unsigned char>(c) >= 0x20 || c == '\t')
      out += c;
  }
  return out;
}

std::string breakable(const std::string& name) {
  std::string out;
  for (const char c : escapeHtml(name)) {
    out += c;
    if (c == '/' || c == '_') out += "<wbr>";
  }
  return out;
}

std::string formatNumber(double value) {
  if (std::isnan(value)) return "–";
  if (std::isinf(value)) return value > 0 ? "∞" : "−∞";
  if (value == std::floor(value) && std::abs(value) < 1e7) return fmt::format("{:.0f}", value + 0.0);
  std::string text = fmt::format("{:.4g}", value);
  const size_t exponent = text.find('e');
  if (exponent == std::string::npos) return text;
  return text.substr(0, exponent) + "e" + std::to_string(std::stoi(text.substr(exponent + 1)));
}

std::string base64(const std::string& bytes) {
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](size_t k) {
      return k < bytes.size() ? static_cast<uint32_t>(static_cast<unsigned char>(bytes[k])) : 0U;
    };
    const uint32_t triple = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    out += digits[triple >> 18];
    out += digits[triple >> 12 & 63];
    out += i + 1 < bytes.size() ? digits[triple >> 6 & 63] : '=';
    out += i + 2 < bytes.size() ? digits[triple & 63] : '=';
  }
  return out;
}

std::string readFileBytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error("cannot be read", path, "check that the file is there");
  return {std::istreambuf_iterator<char>(file), {}};
}

void writeFileBytes(const std::string& path, const std::string& bytes) { replaceFile(path, bytes); }

std::string csvLine(const std::vector<std::string>& fields) {
  std::string out;
  for (const std::string& field : fields) {
    if (&field != &fields.front()) out += ',';
    if (field.find_first_of(",\"\r\n") == std::string::npos) {
      out += field;
      continue;
    }
    out += '"';
    for (const char c : field) out += c == '"' ? "\"\"" : std::string(1, c);
    out += '"';
  }
  return out + "\n";
}

std::optional<double> finiteNumber(const std::string& text) {
  double value = 0.0;
  const char* begin = text.data() + (!text.empty() && text[0] == '+' ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

size_t indexIn(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<size_t>(found - names.begin());
  names.push_back(name);
  return names.size() - 1;
}

std::string counted(size_t count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

void replaceAll(std::string& text, const std::string& from, const std::string& to) {
  for (size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

std::string slug(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)))
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out.substr(0, 60);
}

size_t textWidth(const std::string& text) {
  return static_cast<size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string alignedText(const std::vector<std::vector<std::string>>& rows, const std::vector<size_t>& left,
                        const std::string& indent) {
  std::vector<size_t> widths;
  for (const auto& row : rows)
    for (size_t i = 0; i < row.size(); ++i) {
      if (widths.size() <= i) widths.push_back(0);
      widths[i] = std::max(widths[i], textWidth(row[i]));
    }
  std::string out;
  for (const auto& row : rows) {
    std::string line = indent;
    for (size_t i = 0; i < row.size(); ++i) {
      const std::string blanks(widths[i] - textWidth(row[i]), ' ');
      const bool isLeft = std::find(left.begin(), left.end(), i) != left.end();
      line += (i > 0 ? "  " : "") + (isLeft ? row[i] + blanks : blanks + row[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
  }
  return out;
}

std::string percentText(double share) { return fmt::format("{:.1f} %", 100.0 * share); }

std::string intervalText(const std::optional<Interval>& interval, bool percent) {
  if (!interval || interval->low == interval->high) return "-";
  return percent ? fmt::format("{:.1f} to {:.1f} %", 100.0 * interval->low, 100.0 * interval->high)
                 : fmt::format("{:.3f} to {:.3f}", interval->low, interval->high);
}

std::string fixedText(const std::optional<double>& value, int digits) {
  if (!value || std::isnan(*value)) return "-";
  if (std::isinf(*value)) return *value > 0.0 ? "inf" : "-inf";
  return fmt::format("{:.{}f}", *value, digits);
}

std::string pText(const std::optional<double>& p) {
  if (!p) return "-";
  return *p < 0.0001 ? "< 0.0001" : fmt::format("{:.4f}", *p);
}

}  // namespace limen::analysis
