// SPDX-License-Identifier: BSD-3-Clause
#include <epoxy/gl.h>

#include <cstdlib>

#include "experiments/base/error.h"
#include "renderer/gl/devices.h"
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

TEST_F(ForcedDevice, ANameThatNoDeviceHasIsRefusedWithThoseThereAre) {
  for (const char* text : {"voodoo", "-1", "1x"}) {
    const std::string message = messageFor(text);
    EXPECT_NE(message.find(std::string("'") + text + "' in its name"), std::string::npos) << message;
    EXPECT_NE(message.find(context().device().renderer), std::string::npos) << message;
  }
}

TEST_F(ForcedDevice, APartOfItsNameInAnyCaseChoosesADevice) {
  std::string part = context().device().renderer.substr(1, 5);
  for (char& c : part) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  setenv(kDeviceVariable, part.c_str(), 1);
  EXPECT_EQ(createHeadlessContext()->device().renderer, context().device().renderer);
}

TEST_F(ForcedDevice, ListedDevicesHaveTheIndicesThatChooseThem) {
  const std::vector<DeviceInfo> devices = listHeadlessDevices();
  for (size_t i = 0; i < devices.size(); ++i) {
    if (devices[i].renderer.empty()) continue;
    setenv(kDeviceVariable, std::to_string(i).c_str(), 1);
    EXPECT_EQ(createHeadlessContext()->device().renderer, devices[i].renderer);
  }
}

TEST_F(ForcedDevice, AnIndexPastTheLastSaysHowManyThereAre) {
  EXPECT_NE(messageFor("31").find("there are"), std::string::npos);
}

}  // namespace
}  // namespace limen::gl
