// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cassert>
#include <concepts>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace limen {

/// The names of an enumeration's values, stated once: declarations, readers, printers and shader defines all
/// use this table. An enumeration E has names if `constexpr EnumNames<E, N> enumNames(E)` is declared beside
/// it:
///
///     enum class Raster { Auto, Compute, Hardware };
///     constexpr EnumNames<Raster, 3> enumNames(Raster) {
///       return {{{{Raster::Auto, "auto"}, {Raster::Compute, "compute"}, {Raster::Hardware, "hardware"}}}};
///     }
template <class E, size_t N>
struct EnumNames {
  struct Entry {
    E value;
    const char* name;  ///< snake_case, as in descriptors
  };
  std::array<Entry, N> entries;
};

template <class E>
concept NamedEnum = std::is_enum_v<E> && requires {
  enumNames(E{}).entries;
};

/// The name of a value; "" for a number that is none of the enumeration's values.
template <NamedEnum E>
constexpr const char* toText(E value) {
  for (const auto& entry : enumNames(E{}).entries)
    if (entry.value == value) return entry.name;
  return "";
}

/// All names, in order of declaration.
template <NamedEnum E>
std::vector<std::string> namesOf() {
  std::vector<std::string> names;
  for (const auto& entry : enumNames(E{}).entries) names.emplace_back(entry.name);
  return names;
}

/// The value of that name, which must be one of namesOf().
template <NamedEnum E>
E fromText(std::string_view name) {
  for (const auto& entry : enumNames(E{}).entries)
    if (entry.name == name) return entry.value;
  assert(false && "no value of this enumeration has the name");
  return enumNames(E{}).entries[0].value;
}

/// What a shader needs to compare with names in place of numbers: with prefix "STRUCTURE" and values none and
/// ysm, STRUCTURE_NONE and STRUCTURE_YSM are their numbers and STRUCTURE is that of `value`.
template <NamedEnum E>
void defineEnum(std::map<std::string, std::string>& defines, const std::string& prefix, E value) {
  for (const auto& entry : enumNames(E{}).entries) {
    std::string name = prefix + "_";
    for (const char* c = entry.name; *c; ++c)
      name += *c >= 'a' && *c <= 'z' ? static_cast<char>(*c - 'a' + 'A') : *c;
    defines[name] = std::to_string(static_cast<long long>(entry.value));
  }
  defines[prefix] = std::to_string(static_cast<long long>(value));
}

}  // namespace limen
