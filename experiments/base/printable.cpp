// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/printable.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>

#include "experiments/base/error.h"

namespace limen {
namespace {

/// Bytes of the UTF-8 character at `at`, or 0 if there is none (Unicode 15, table 3-7); `code` is set to it.
size_t characterAt(const std::string& text, size_t at, uint32_t& code) {
  const auto byte = [&](size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const uint32_t first = byte(at);
  code = first;
  if (first < 0x80) return 1;
  const size_t length = first >= 0xc2 && first < 0xe0   ? 2
                        : first >= 0xe0 && first < 0xf0 ? 3
                        : first >= 0xf0 && first < 0xf5 ? 4
                                                        : 0;
  if (length == 0) return 0;
  code = first & (0xffU >> (length + 1));
  for (size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xc0U) != 0x80U) return 0;
    code = code << 6U | (byte(at + i) & 0x3fU);
  }
  constexpr uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  return code < kLeast[length] || surrogate || code > 0x10ffff ? 0 : length;
}

bool isControl(uint32_t code) {
  return (code < 0x20 && code != '\n' && code != '\t') || (code >= 0x7f && code < 0xa0);
}

/// Marks, embeddings, overrides and isolates of direction, and separators of lines.
bool turnsWriting(uint32_t code) {
  return code == 0x200e || code == 0x200f || code == 0x061c || (code >= 0x2028 && code <= 0x202e) ||
         (code >= 0x2066 && code <= 0x2069);
}

std::string escaped(const char* form, uint32_t code) {
  char out[16];
  std::snprintf(out, sizeof out, form, static_cast<unsigned>(code));
  return out;
}

}  // namespace

std::string printable(const std::string& text) {
  std::string out;
  out.reserve(text.size());
  for (size_t at = 0; at < text.size();) {
    uint32_t code = 0;
    const size_t length = characterAt(text, at, code);
    if (length == 0)
      out += escaped("\\x%02x", static_cast<unsigned char>(text[at]));
    else if (isControl(code))
      out += escaped("\\x%02x", code);
    else if (turnsWriting(code))
      out += escaped("\\u%04x", code);
    else
      out.append(text, at, length);
    at += std::max<size_t>(length, 1);
  }
  return out;
}

void requirePlainName(const std::string& name, const std::string& where) {
  if (std::any_of(name.begin(), name.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte < 0x20 || byte == 0x7f;
      }))
    throw Error("the name '" + name + "' holds control characters", where, "give another name");
}

}  // namespace limen
