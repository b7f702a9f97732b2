// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/registry.h"

#include <gtest/gtest.h>

namespace limen {
namespace {

struct Early {
  static constexpr const char* kKind = "early";
  std::string name;
};
struct Late {
  static constexpr const char* kKind = "late";
  std::string name;
};

// Registered before what it is made from.
const RegisteredLater<Late> kLate{
    [] { return Late{"of_" + std::to_string(Registry<Early>::instance().names().size())}; }};
const Registered<Late> kAtOnce{Late{"at_once"}};
const Registered<Early> kOne{Early{"one"}}, kTwo{Early{"two"}};

TEST(Registry, MakesLateEntriesWhenItIsFirstAsked) {
  const Registry<Late>& registry = Registry<Late>::instance();
  EXPECT_EQ(registry.names(), (std::vector<std::string>{"at_once", "of_2"}));
  EXPECT_EQ(registry.all().size(), 2U) << "once only";
  EXPECT_NE(registry.find("of_2"), nullptr);
  EXPECT_THROW(registry.get("of_3"), Error);
}

}  // namespace
}  // namespace limen
