// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/mutation.h"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace limen::fuzz {
namespace {

std::string spliced(Random& random, std::string text, const std::string& other) {
  const size_t from = random.below(other.size()),
               count = random.below(std::min<size_t>(other.size(), 400)) + 1;
  const size_t at = random.below(text.size() + 1), over = random.chance(0.5) ? random.below(count) : 0;
  return text.replace(at, std::min(over, text.size() - at), other.substr(from, count));
}

std::string extremes(Random& random) {
  static const std::vector<std::string> kBytes = {std::string(4, '\0'),
                                                  std::string(4, '\xff'),
                                                  std::string("\xff\xff\xff\x7f", 4),
                                                  std::string("\x7f\xff\xff\xff", 4),
                                                  std::string("\0\0\0\x80", 4),
                                                  std::string("\x80\0\0\0", 4),
                                                  std::string("\0\0\x80\x7f", 4),
                                                  std::string("\x7f\x80\0\0", 4),
                                                  std::string("\xff\xff", 2),
                                                  std::string("\0\x01", 2),
                                                  std::string(8, '\xff'),
                                                  std::string("\0\0\0\0\0\0\xf0\x7f", 8)};
  return random.pick(kBytes);
}

void mutateBytesOnce(Random& random, std::string& text, const std::vector<std::string>& corpus) {
  const size_t at = random.below(text.size());
  switch (random.below(9)) {
    case 0:
    case 1:
      if (!text.empty()) text[at] = static_cast<char>(text[at] ^ (1 << random.below(8)));
      break;
    case 2:
      if (!text.empty()) text[at] = static_cast<char>(random.below(256));
      break;
    case 3:
      text.erase(at, random.below(16) + 1);
      break;
    case 4:
      text.insert(at, std::string(random.below(40) + 1, static_cast<char>(random.below(256))));
      break;
    case 5:
      if (random.chance(0.3)) text.resize(at);
      break;
    case 6: {
      const std::string bytes = extremes(random);
      text.replace(at, bytes.size(), bytes);
      break;
    }
    case 7:
      text.insert(at, text.substr(random.below(text.size() + 1), random.below(200)));
      break;
    default:
      text = spliced(random, text, random.pick(corpus));
  }
}

bool isWord(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '+' || c == '_';
}

/// The word, or number, around a place.
std::pair<size_t, size_t> wordAt(const std::string& text, size_t at) {
  while (at < text.size() && !isWord(text[at])) ++at;
  size_t begin = at;
  while (begin > 0 && isWord(text[begin - 1])) --begin;
  while (at < text.size() && isWord(text[at])) ++at;
  return {begin, at - begin};
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) out.push_back(line);
  if (out.empty()) out.emplace_back();
  return out;
}

template <class Parts>
std::string joined(const Parts& parts, char separator) {
  std::string out;
  for (const std::string& part : parts) (out += part) += separator;
  if (!out.empty()) out.pop_back();
  return out;
}

std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> out(1);
  for (const char c : line)
    if (c == ',')
      out.emplace_back();
    else
      out.back() += c;
  return out;
}

}  // namespace

const std::string& oddValue(Random& random) {
  static const std::vector<std::string> kValues = {"-1",
                                                   "0",
                                                   "1",
                                                   "2",
                                                   "-0",
                                                   "0.5",
                                                   "1e308",
                                                   "-1e308",
                                                   "1e309",
                                                   "1e-320",
                                                   "1e-9",
                                                   "nan",
                                                   ".nan",
                                                   "-nan",
                                                   "inf",
                                                   ".inf",
                                                   "-.inf",
                                                   "2147483647",
                                                   "2147483648",
                                                   "-2147483648",
                                                   "-2147483649",
                                                   "4294967296",
                                                   "1000000",
                                                   "999999999",
                                                   "9223372036854775807",
                                                   "9223372036854775808",
                                                   "18446744073709551615",
                                                   "99999999999999999999999999",
                                                   "0x7fffffff",
                                                   "0777",
                                                   "1_000",
                                                   "1,5",
                                                   "true",
                                                   "no",
                                                   "~",
                                                   "null",
                                                   "",
                                                   "\"\"",
                                                   "''",
                                                   "[]",
                                                   "{}",
                                                   "[[]]",
                                                   "{a: {b: {c: 1}}}",
                                                   "\"",
                                                   "'",
                                                   "`",
                                                   ":",
                                                   ": ",
                                                   "- ",
                                                   "? ",
                                                   "#",
                                                   "%",
                                                   "%n%s",
                                                   "@x",
                                                   "&a 1",
                                                   "*a",
                                                   "!!binary aaaa",
                                                   "---\n",
                                                   "...\n",
                                                   "|\n",
                                                   ">\n",
                                                   "\n",
                                                   "\r\n",
                                                   "\t",
                                                   "{",
                                                   "}",
                                                   "[",
                                                   "]",
                                                   ",",
                                                   ",,,",
                                                   ";",
                                                   "= 1/0",
                                                   "= a",
                                                   "= ((((",
                                                   "= 1e308*1e308",
                                                   "= -(-(-1))",
                                                   "/dev/null",
                                                   "/dev/zero",
                                                   "/",
                                                   "..",
                                                   "a/../../b",
                                                   std::string(1, '\0'),
                                                   "\x1b[2J",
                                                   "\x07",
                                                   "\x7f",
                                                   "\xff",
                                                   "\xc2\x9b",
                                                   "\xe2\x80\xae",
                                                   "\xed\xa0\x80",
                                                   "\xf0\x9f\x98\x80",
                                                   "\xef\xbb\xbf",
                                                   "\xc3\xa9",
                                                   std::string(3000, 'a'),
                                                   std::string(300, '9'),
                                                   std::string(70, '['),
                                                   std::string(200, '(')};
  return random.pick(kValues);
}

std::string mutateBytes(Random& random, const std::string& input, const std::vector<std::string>& corpus) {
  std::string text = input;
  for (size_t i = random.below(4) + 1; i > 0; --i) mutateBytesOnce(random, text, corpus);
  return text;
}

std::string mutateText(Random& random, const std::string& input, const std::vector<std::string>& corpus) {
  std::string text = input;
  for (size_t i = random.below(3) + 1; i > 0; --i) {
    const auto [begin, length] = wordAt(text, random.below(text.size()));
    const size_t kind = random.below(4);
    if (kind == 0)
      mutateBytesOnce(random, text, corpus);
    else if (kind == 1)
      text.insert(begin, oddValue(random));
    else
      text.replace(begin, length, oddValue(random));
  }
  return text;
}

std::string mutateCsv(Random& random, const std::string& input, const std::vector<std::string>& corpus) {
  if (random.chance(0.3)) return mutateText(random, input, corpus);
  std::vector<std::string> lines = linesOf(input);
  for (size_t i = random.below(3) + 1; i > 0; --i) {
    const size_t at = random.below(lines.size());
    std::vector<std::string> cells = cellsOf(lines[at]);
    const size_t column = random.below(cells.size());
    switch (random.below(7)) {
      case 0:
        lines.insert(lines.begin() + static_cast<ptrdiff_t>(at), random.pick(lines));
        continue;
      case 1:
        if (lines.size() > 1) lines.erase(lines.begin() + static_cast<ptrdiff_t>(at));
        continue;
      case 2:
        cells.erase(cells.begin() + static_cast<ptrdiff_t>(column));
        break;
      case 3:
        cells.insert(cells.begin() + static_cast<ptrdiff_t>(column), oddValue(random));
        break;
      case 4: {  // a whole column
        const std::string value = oddValue(random);
        for (size_t row = 1; row < lines.size(); ++row) {
          std::vector<std::string> others = cellsOf(lines[row]);
          if (column < others.size()) others[column] = value;
          lines[row] = joined(others, ',');
        }
        continue;
      }
      default:
        cells[column] = random.chance(0.3) ? random.pick(cellsOf(random.pick(lines))) : oddValue(random);
    }
    lines[at] = joined(cells, ',');
  }
  return joined(lines, '\n') + '\n';
}

}  // namespace limen::fuzz
