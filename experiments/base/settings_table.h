// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "experiments/base/enum_names.h"
#include "experiments/base/parameter.h"

/// Settings are structs, and each struct has one table that binds its members to their declarations:
///
///     struct PcfSettings {
///       int filterRadius = 4;
///       Raster raster = Raster::Auto;
///       std::variant<Uniform, Radial> budget;
///       static const SettingsTable<PcfSettings>& table();
///     };
///     const SettingsTable<PcfSettings>& PcfSettings::table() {
///       static const SettingsTable<PcfSettings> kTable = {
///           {&PcfSettings::filterRadius, "filter_radius", {1, 64}, "px", "Half-width of the window",
///           "Schwarz 2009, 3.4"},
///           {&PcfSettings::raster, "raster", "How the map is rasterised"},
///           {&PcfSettings::budget, "budget", "Micro-occluders allowed per pixel"}};
///       return kTable;
///     }
///
/// Members' initial values are the declared defaults. A member may be
///   - a number: range, unit; a whole number may instead have a list of allowed values, oneOf({64, 128,
///   256});
///   - bool; std::string (free text); FilePath (a file that the descriptor names);
///   - an enumeration with names (enum_names.h);
///   - std::string with Names{...}: one of several names known only at run time;
///   - another settings struct: a group, written as a map under its name;
///   - std::variant of alternatives, each with parameters of its own. An alternative states
///     `static constexpr const char *kKind, *kSummary;` and has a table() if it has parameters;
///   - included(&S::member): the members of another settings struct appear on this struct's own level;
///   - ChosenEntry: an entry of a registry, with its own settings (see chosen_entry.h).
/// A settings struct may have `void check() const`, which throws Error, `where` being a path within the
/// struct, if values contradict each other. Tables are made on first use, never before main().
namespace limen {

/// Inclusive.
struct Range {
  double least, most;
};
/// The allowed whole numbers.
struct OneOf {
  std::vector<int64_t> numbers;
};
inline OneOf oneOf(std::vector<int64_t> numbers) { return {std::move(numbers)}; }
/// The allowed names.
struct Names {
  std::vector<std::string> names;
};
/// Path of a file; "" if none is given. As a setting it must be given unless it is declared Optional.
struct FilePath {
  std::string path;
  friend bool operator==(const FilePath&, const FilePath&) = default;
};
enum class FileIs { Required, Optional };

class SettingsLayout;

template <class S>
concept Settings = requires {
  { S::table() } -> std::convertible_to<const SettingsLayout&>;
};

/// Reaches one member of some settings struct, whose address is given without its type.
class MemberAccess {
 public:
  virtual ~MemberAccess() = default;
  /// Adds the member's declarations; their defaults are the values in `defaults`.
  virtual void declare(const Parameter& stated, const void* defaults, std::vector<Parameter>& out) const = 0;
  virtual void read(const Parameter& stated, void* settings, const ParameterValues& values,
                    const std::string& prefix) const = 0;
  virtual void write(const Parameter& stated, const void* settings, const std::string& prefix,
                     std::map<std::string, ParameterValue>& out) const = 0;
};

/// The type-independent part of a settings table, which the template would otherwise instantiate for each
/// struct.
class SettingsLayout {
 public:
  struct Member {
    Parameter stated;  ///< all but the default
    std::shared_ptr<const MemberAccess> access;
  };
  using Check = void (*)(const void*);

  SettingsLayout(std::vector<Member> members, Check check) : members_(std::move(members)), check_(check) {}

  std::vector<Parameter> parametersOf(const void* defaults) const;
  /// Throws Error if values contradict each other; its `where` is then a path.
  void readInto(void* settings, const ParameterValues& values, const std::string& prefix) const;
  void writeFrom(const void* settings, const std::string& prefix,
                 std::map<std::string, ParameterValue>& out) const;

 private:
  std::vector<Member> members_;
  Check check_;
};

namespace settings {

/// Base of members that hold one value.
class ValueAccess : public MemberAccess {
 public:
  virtual ParameterValue get(const void* settings) const = 0;
  virtual void set(void* settings, const ParameterValue& value) const = 0;

  void declare(const Parameter& stated, const void* defaults, std::vector<Parameter>& out) const override;
  void read(const Parameter& stated, void* settings, const ParameterValues& values,
            const std::string& prefix) const override;
  void write(const Parameter& stated, const void* settings, const std::string& prefix,
             std::map<std::string, ParameterValue>& out) const override;
};

/// Base of members that are settings structs themselves.
class StructAccess : public MemberAccess {
 public:
  /// `named`: a group under its own name; otherwise its members appear beside the others.
  explicit StructAccess(bool named) : named_(named) {}
  virtual const void* member(const void* settings) const = 0;
  virtual void* member(void* settings) const = 0;
  virtual const SettingsLayout& layout() const = 0;

  void declare(const Parameter& stated, const void* defaults, std::vector<Parameter>& out) const override;
  void read(const Parameter& stated, void* settings, const ParameterValues& values,
            const std::string& prefix) const override;
  void write(const Parameter& stated, const void* settings, const std::string& prefix,
             std::map<std::string, ParameterValue>& out) const override;

 private:
  bool named_;
};

/// One alternative of a variant.
struct AlternativeType {
  const char *kind, *summary;
  const SettingsLayout* layout;  ///< null: no parameters
};

/// Base of members that are one of several alternatives.
class VariantAccess : public MemberAccess {
 public:
  virtual std::vector<AlternativeType> types() const = 0;
  virtual size_t index(const void* settings) const = 0;
  virtual const void* held(const void* settings) const = 0;
  /// Makes the member hold a new alternative; returns it.
  virtual void* emplace(void* settings, size_t index) const = 0;
  /// A new alternative, to read defaults from.
  virtual std::shared_ptr<void> make(size_t index) const = 0;

  void declare(const Parameter& stated, const void* defaults, std::vector<Parameter>& out) const override;
  void read(const Parameter& stated, void* settings, const ParameterValues& values,
            const std::string& prefix) const override;
  void write(const Parameter& stated, const void* settings, const std::string& prefix,
             std::map<std::string, ParameterValue>& out) const override;
};

template <class T>
ParameterValue toValue(const T& member) {
  if constexpr (std::is_same_v<T, bool>)
    return member;
  else if constexpr (NamedEnum<T>)
    return std::string(toText(member));
  else if constexpr (std::is_integral_v<T>)
    return static_cast<int64_t>(member);
  else if constexpr (std::is_floating_point_v<T>)
    return static_cast<double>(member);
  else if constexpr (std::is_same_v<T, FilePath>)
    return member.path;
  else
    return member;
}

template <class T>
void fromValue(const ParameterValue& value, T& member) {
  if constexpr (std::is_same_v<T, bool>)
    member = std::get<bool>(value);
  else if constexpr (NamedEnum<T>)
    member = fromText<T>(std::get<std::string>(value));
  else if constexpr (std::is_integral_v<T>)
    member = static_cast<T>(std::get<int64_t>(value));
  else if constexpr (std::is_floating_point_v<T>)
    member = static_cast<T>(std::get<double>(value));
  else if constexpr (std::is_same_v<T, FilePath>)
    member.path = std::get<std::string>(value);
  else
    member = std::get<std::string>(value);
}

template <class S, class T>
class ValueMember : public ValueAccess {
 public:
  explicit ValueMember(T S::*member) : member_(member) {}
  ParameterValue get(const void* settings) const override {
    return toValue(static_cast<const S*>(settings)->*member_);
  }
  void set(void* settings, const ParameterValue& value) const override {
    fromValue(value, static_cast<S*>(settings)->*member_);
  }

 private:
  T S::*member_;
};

template <class S, class T>
class StructMember : public StructAccess {
 public:
  StructMember(T S::*member, bool named) : StructAccess(named), member_(member) {}
  const void* member(const void* settings) const override {
    return &(static_cast<const S*>(settings)->*member_);
  }
  void* member(void* settings) const override { return &(static_cast<S*>(settings)->*member_); }
  const SettingsLayout& layout() const override { return T::table(); }

 private:
  T S::*member_;
};

template <class A>
const SettingsLayout* layoutOf() {
  if constexpr (Settings<A>)
    return &static_cast<const SettingsLayout&>(A::table());
  else
    return nullptr;
}

template <class S, class... A>
class VariantMember : public VariantAccess {
 public:
  using Variant = std::variant<A...>;
  explicit VariantMember(Variant S::*member) : member_(member) {}
  std::vector<AlternativeType> types() const override {
    return {AlternativeType{A::kKind, A::kSummary, layoutOf<A>()}...};
  }
  size_t index(const void* settings) const override {
    return (static_cast<const S*>(settings)->*member_).index();
  }
  const void* held(const void* settings) const override {
    return std::visit([](const auto& alternative) -> const void* { return &alternative; },
                      static_cast<const S*>(settings)->*member_);
  }
  void* emplace(void* settings, size_t index) const override {
    Variant& variant = static_cast<S*>(settings)->*member_;
    variant = fresh(index, std::index_sequence_for<A...>{});
    return std::visit([](auto& alternative) -> void* { return &alternative; }, variant);
  }
  std::shared_ptr<void> make(size_t index) const override {
    const auto variant = std::make_shared<Variant>(fresh(index, std::index_sequence_for<A...>{}));
    void* held = std::visit([](auto& alternative) -> void* { return &alternative; }, *variant);
    return {variant, held};
  }

 private:
  template <size_t... I>
  static Variant fresh(size_t index, std::index_sequence<I...>) {
    Variant out;
    ((index == I ? static_cast<void>(out.template emplace<I>()) : void()), ...);
    return out;
  }
  Variant S::*member_;
};

template <class S>
void check(const void* settings) {
  static_cast<const S*>(settings)->check();
}

template <class S>
constexpr SettingsLayout::Check checkOf() {
  if constexpr (requires(const S& settings) { settings.check(); })
    return &check<S>;
  else
    return nullptr;
}

template <class T>
concept Number = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

Parameter state(ParameterType type, std::string name, std::string description, std::string source);

}  // namespace settings

/// One line of a settings table.
template <class S>
class Binding {
 public:
  /// A number within `range`.
  template <settings::Number T>
  Binding(T S::*member, std::string name, Range range, std::string unit, std::string description,
          std::string source = {})
      : Binding(std::is_integral_v<T> ? ParameterType::Integer : ParameterType::Real, member, std::move(name),
                std::move(description), std::move(source)) {
    stated_.minimum = range.least;
    stated_.maximum = range.most;
    stated_.unit = std::move(unit);
  }
  /// One of a few whole numbers.
  template <std::integral T>
  Binding(T S::*member, std::string name, OneOf allowed, std::string unit, std::string description,
          std::string source = {})
      : Binding(ParameterType::Integer, member, std::move(name), std::move(description), std::move(source)) {
    stated_.allowed = std::move(allowed.numbers);
    stated_.unit = std::move(unit);
  }
  Binding(bool S::*member, std::string name, std::string description, std::string source = {})
      : Binding(ParameterType::Boolean, member, std::move(name), std::move(description), std::move(source)) {}
  /// Free text.
  Binding(std::string S::*member, std::string name, std::string description, std::string source = {})
      : Binding(ParameterType::Text, member, std::move(name), std::move(description), std::move(source)) {}
  /// One of several names known at run time.
  Binding(std::string S::*member, std::string name, Names names, std::string description,
          std::string source = {})
      : Binding(ParameterType::Choice, member, std::move(name), std::move(description), std::move(source)) {
    stated_.choices = std::move(names.names);
  }
  Binding(FilePath S::*member, std::string name, FileIs is, std::string description, std::string source = {})
      : Binding(ParameterType::File, member, std::move(name), std::move(description), std::move(source)) {
    stated_.required = is == FileIs::Required;
  }
  template <NamedEnum E>
  Binding(E S::*member, std::string name, std::string description, std::string source = {})
      : Binding(ParameterType::Choice, member, std::move(name), std::move(description), std::move(source)) {
    stated_.choices = namesOf<E>();
  }
  /// A group.
  template <Settings T>
  Binding(T S::*member, std::string name, std::string description, std::string source = {})
      : stated_(settings::state(ParameterType::Group, std::move(name), std::move(description),
                                std::move(source))),
        access_(std::make_shared<settings::StructMember<S, T>>(member, true)) {}
  /// One of several alternatives.
  template <class... A>
  Binding(std::variant<A...> S::*member, std::string name, std::string description, std::string source = {})
      : stated_(settings::state(ParameterType::Choice, std::move(name), std::move(description),
                                std::move(source))),
        access_(std::make_shared<settings::VariantMember<S, A...>>(member)) {
    stated_.choices = {A::kKind...};
  }
  /// Any other kind of member.
  Binding(Parameter stated, std::shared_ptr<const MemberAccess> access)
      : stated_(std::move(stated)), access_(std::move(access)) {}

  /// A number in place of the choice sets this parameter of the default alternative.
  Binding&& shorthand(std::string member) && {
    stated_.shorthand = std::move(member);
    return std::move(*this);
  }
  /// Former names of this parameter; an error replies to them with the present form.
  Binding&& formerly(std::vector<std::string> names) && {
    stated_.formerNames = std::move(names);
    return std::move(*this);
  }
  /// What axes and columns call it, without the unit, if the words of its name will not do.
  Binding&& titled(std::string title) && {
    stated_.title = std::move(title);
    return std::move(*this);
  }
  /// This choice decides the defaults of its neighbours; see Parameter::preset.
  Binding&& presets(std::map<std::string, ParameterValue> (*of)(const std::string& choice)) && {
    stated_.preset = of;
    return std::move(*this);
  }
  /// At its default it is not part of run keys.
  Binding&& keyedIfGiven() && {
    stated_.keyedIfGiven = true;
    return std::move(*this);
  }

  SettingsLayout::Member member() const { return {stated_, access_}; }

 private:
  template <class T>
  Binding(ParameterType type, T S::*member, std::string name, std::string description, std::string source)
      : stated_(settings::state(type, std::move(name), std::move(description), std::move(source))),
        access_(std::make_shared<settings::ValueMember<S, T>>(member)) {}

  Parameter stated_;
  std::shared_ptr<const MemberAccess> access_;
};

/// The members of another settings struct, on the level of this one.
template <class S, Settings T>
Binding<S> included(T S::*member) {
  return {Parameter{}, std::make_shared<settings::StructMember<S, T>>(member, false)};
}

/// The declaration of settings struct S.
template <class S>
class SettingsTable : public SettingsLayout {
 public:
  SettingsTable(std::initializer_list<Binding<S>> bindings)
      : SettingsLayout(membersOf(bindings), settings::checkOf<S>()) {}

  /// Declarations whose defaults are the values in `defaults`.
  std::vector<Parameter> parameters(const S& defaults = S{}) const { return parametersOf(&defaults); }
  /// Settings from complete values. Throws Error if values contradict each other.
  S read(const ParameterValues& values, const std::string& prefix = {}) const {
    S settings;
    readInto(&settings, values, prefix);
    return settings;
  }
  /// The values that read() turns into `settings`.
  std::map<std::string, ParameterValue> write(const S& settings, const std::string& prefix = {}) const {
    std::map<std::string, ParameterValue> out;
    writeFrom(&settings, prefix, out);
    return out;
  }

 private:
  static std::vector<Member> membersOf(std::initializer_list<Binding<S>> bindings) {
    std::vector<Member> members;
    for (const Binding<S>& binding : bindings) members.push_back(binding.member());
    return members;
  }
};

}  // namespace limen
