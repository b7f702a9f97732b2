// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include "renderer/gl/context.h"

namespace limen::gl {

/// Tests that need OpenGL: one headless context a test program, and no test passes whose calls the driver
/// complained about (medium severity or higher; advice on speed is let pass).
class GlTest : public testing::Test {
 protected:
  static Context& context() {
    static const std::unique_ptr<Context> shared = createHeadlessContext();
    return *shared;
  }
  void SetUp() override { context().takeDebugMessages(); }
  void TearDown() override {
    for (const DebugMessage& message : context().takeDebugMessages())
      EXPECT_TRUE(message.performance) << "the OpenGL driver reports: " << message.text;
  }
};

}  // namespace limen::gl
