// SPDX-License-Identifier: BSD-3-Clause
#include <epoxy/gl.h>

#include <cstdlib>

#include "experiments/base/error.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::gl {
namespace {

class ContextTest : public GlTest {};

TEST_F(ContextTest, IsOpenGl45CoreAndNamesItsDevice) {
  GLint major = 0, minor = 0, profile = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
  EXPECT_GE(10 * major + minor, 45);
  EXPECT_NE(profile & GL_CONTEXT_CORE_PROFILE_BIT, 0);
  EXPECT_FALSE(context().device().renderer.empty());
  EXPECT_FALSE(headlessCandidates().empty());
}

TEST_F(ContextTest, RowZeroIsTheTopAndDepthRunsFromZeroToOne) {
  GLint origin = 0, depth = 0;
  glGetIntegerv(GL_CLIP_ORIGIN, &origin);
  glGetIntegerv(GL_CLIP_DEPTH_MODE, &depth);
  EXPECT_EQ(origin, GL_UPPER_LEFT);
  EXPECT_EQ(depth, GL_ZERO_TO_ONE);
}

TEST_F(ContextTest, AMistakeIsReportedWithTheDriversWords) {
  glBindTextureUnit(0, 0x7fffffff);  // no such texture
  EXPECT_THROW(context().checkDebugMessages(), std::runtime_error);
  EXPECT_NO_THROW(context().checkDebugMessages()) << "messages are given once";
}

class ForcedDevice : public ContextTest {
 protected:
  void TearDown() override {
    unsetenv("LIMEN_EGL_DEVICE");
    context().makeCurrent();
    ContextTest::TearDown();
  }
  std::string messageFor(const char* device) {
    setenv("LIMEN_EGL_DEVICE", device, 1);
    try {
      createHeadlessContext();
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }
};

TEST_F(ForcedDevice, ANonNumberIsRefused) {
  for (const char* text : {"first", "-1", "1x"})
    EXPECT_NE(messageFor(text).find("give the index of an EGL device"), std::string::npos) << text;
}

TEST_F(ForcedDevice, AnIndexPastTheLastSaysHowManyThereAre) {
  EXPECT_NE(messageFor("31").find("there are"), std::string::npos);
}

}  // namespace
}  // namespace limen::gl
