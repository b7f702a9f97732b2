// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gl/program.h"

#include <epoxy/gl.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "experiments/base/error.h"
#include "renderer/gl/buffer.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::gl {
namespace {

/// Shaders are read from a folder of the test's own.
class ProgramTest : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    root_ = std::filesystem::temp_directory_path() / ("limen-program-test-" + std::to_string(::getpid()));
    std::filesystem::create_directories(root_);
    setenv("LIMEN_SHADER_ROOT", root_.c_str(), 1);
  }
  void TearDown() override {
    unsetenv("LIMEN_SHADER_ROOT");
    std::filesystem::remove_all(root_);
    GlTest::TearDown();
  }
  void write(const std::string& name, const std::string& text) { std::ofstream(root_ / name) << text; }
  /// Message of the exception that building the compute shader gives.
  std::string failureOf(const std::string& name) {
    try {
      const Program program({name}, {});
    } catch (const std::exception& error) {
      context().takeDebugMessages();  // the driver repeats its log there
      return error.what();
    }
    return "no error";
  }
  /// Runs a compute shader of one invocation that writes result[0].
  uint32_t resultOf(const std::string& name, const ShaderDefines& defines = {}) {
    const Program program({name}, defines);
    const Buffer result(std::vector<uint32_t>{0});
    result.bindStorage(0);
    program.dispatch({1, 1}, {1, 1});
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
    return result.read<uint32_t>()[0];
  }

 private:
  std::filesystem::path root_;
};

constexpr const char* kHead =
    "layout(local_size_x = 1) in;\nlayout(std430, binding = 0) buffer R { uint result[]; };\n";

TEST_F(ProgramTest, AnErrorInAnIncludedFileIsToldWithThatFileAndLine) {
  write("good.glsl", "uint one() { return 1u; }\n");
  write("bad.glsl", "// first line\n// second line\nuint broken() { return nothing; }\n");
  write("main.comp.glsl",
        std::string(kHead) + "#include \"good.glsl\"\n#include \"bad.glsl\"\nvoid main() {}\n");
  const std::string message = failureOf("main.comp.glsl");
  EXPECT_NE(message.find("bad.glsl:3"), std::string::npos) << message;
}

TEST_F(ProgramTest, AnErrorAfterAnIncludeIsToldWithItsOwnLine) {
  write("good.glsl", "uint one() { return 1u; }\nuint two() { return 2u; }\n");
  write("main.comp.glsl", std::string(kHead) + "#include \"good.glsl\"\n\nvoid main() { nothing(); }\n");
  const std::string message = failureOf("main.comp.glsl");
  EXPECT_NE(message.find("main.comp.glsl:5"), std::string::npos) << message;
}

TEST_F(ProgramTest, AFileIncludedTwiceOrByItselfIsTakenOnce) {
  write("a.glsl", "#include \"b.glsl\"\nuint a() { return 40u + b(); }\n");
  write("b.glsl", "#include \"a.glsl\"\nuint b() { return 2u; }\n");
  write("main.comp.glsl",
        std::string(kHead) + "#include \"a.glsl\"\n#include \"b.glsl\"\nvoid main() { result[0] = a(); }\n");
  EXPECT_EQ(resultOf("main.comp.glsl"), 42U);
}

TEST_F(ProgramTest, AMissingIncludeNamesFileAndLineThatAskedForIt) {
  write("main.comp.glsl", std::string(kHead) + "#include \"absent.glsl\"\nvoid main() {}\n");
  const std::string message = failureOf("main.comp.glsl");
  EXPECT_NE(message.find("absent.glsl"), std::string::npos) << message;
  EXPECT_NE(message.find("main.comp.glsl:3"), std::string::npos) << message;
}

TEST_F(ProgramTest, DefinesMakeProgramsOfTheirOwn) {
  write("main.comp.glsl", std::string(kHead) + "void main() { result[0] = VALUE; }\n");
  EXPECT_EQ(resultOf("main.comp.glsl", {{"VALUE", "7u"}}), 7U);
  EXPECT_EQ(resultOf("main.comp.glsl", {{"VALUE", "9u"}}), 9U);
  ProgramCache cache;
  const Program& seven = cache.compute("main.comp.glsl", {{"VALUE", "7u"}});
  EXPECT_EQ(&seven, &cache.compute("main.comp.glsl", {{"VALUE", "7u"}}));
  EXPECT_NE(&seven, &cache.compute("main.comp.glsl", {{"VALUE", "9u"}}));
}

TEST_F(ProgramTest, AUniformThatTheCompilerRemovedIsIgnored) {
  write("main.comp.glsl",
        std::string(kHead) + "uniform int used, spare;\nvoid main() { result[0] = uint(used); }\n");
  const Program program({"main.comp.glsl"}, {});
  program.set("used", 5);
  program.set("spare", 6);
  program.set("neverDeclared", 1.0F);
  const Buffer result(std::vector<uint32_t>{0});
  result.bindStorage(0);
  program.dispatch({1, 1}, {1, 1});
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
  EXPECT_EQ(result.read<uint32_t>()[0], 5U);
}

}  // namespace
}  // namespace limen::gl
