// SPDX-License-Identifier: BSD-3-Clause
#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>

#include "experiments/base/error.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::gl {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kStart =
    "layout(local_size_x = 1) in;\nlayout(std430, binding = 0) buffer R { uint result[]; };\n";

std::string giving(const std::string& value) {
  return kStart + "void main() { result[0] = " + value + "; }\n";
}

const EmbeddedShader kEmbedded{"embedded.comp.glsl",
                               "layout(local_size_x = 1) in;\n"
                               "layout(std430, binding = 0) buffer R { uint result[]; };\n"
                               "void main() { result[0] = 5u; }\n"};

/// A source tree of the test's own.
class ProgramReload : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    std::string pattern = (fs::temp_directory_path() / "limen_reload_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    root_ = pattern;
    if (const char* before = std::getenv("LIMEN_SHADER_ROOT")) before_ = before;
    setShaderRoot(root_);
  }
  void TearDown() override {
    if (before_)
      setShaderRoot(*before_);
    else
      unsetenv("LIMEN_SHADER_ROOT");
    fs::remove_all(root_);
    GlTest::TearDown();
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(root_ / name, std::ios::binary) << text;
  }
  /// As written so long ago that the file's time tells all about it.
  void age(const std::string& name, int minutes) const {
    fs::last_write_time(root_ / name, fs::file_time_type::clock::now() - std::chrono::minutes(minutes));
  }
  ProgramCache::Reload reload() {
    ProgramCache::Reload out = cache_.reloadChanged();
    if (!out.failures.empty()) context().takeDebugMessages();  // the driver repeats its log there
    return out;
  }
  void expectNothingHappens() {
    const ProgramCache::Reload again = reload();
    EXPECT_THAT(again.rebuilt, IsEmpty());
    EXPECT_THAT(again.failures, IsEmpty());
  }
  static uint32_t resultOf(const Program& program) {
    const Buffer result(std::vector<uint32_t>{0});
    result.bindStorage(0);
    program.dispatch({1, 1}, {1, 1});
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
    return result.read<uint32_t>()[0];
  }

  ProgramCache cache_;
  fs::path root_;

 private:
  std::optional<std::string> before_;
};

TEST_F(ProgramReload, AChangedFileChangesWhatReferencesMean) {
  write("a.comp.glsl", giving("1u"));
  write("b.comp.glsl", giving("10u"));
  const Program &a = cache_.compute("a.comp.glsl"), &b = cache_.compute("b.comp.glsl");
  EXPECT_EQ(resultOf(a), 1U);
  expectNothingHappens();
  // Of the same length and within the same tick of the clock: the time of modification may be the same.
  write("a.comp.glsl", giving("2u"));
  const ProgramCache::Reload changed = reload();
  EXPECT_THAT(changed.rebuilt, ElementsAre("a.comp.glsl"));
  EXPECT_THAT(changed.failures, IsEmpty());
  EXPECT_EQ(resultOf(a), 2U);
  EXPECT_EQ(resultOf(b), 10U);
  EXPECT_EQ(&cache_.compute("a.comp.glsl"), &a);
  expectNothingHappens();
}

TEST_F(ProgramReload, AChangeIsSeenByTheFilesTimeOrSize) {
  write("a.comp.glsl", giving("1u"));
  age("a.comp.glsl", 60);
  const Program& a = cache_.compute("a.comp.glsl");
  expectNothingHappens();
  write("a.comp.glsl", giving("2u"));
  age("a.comp.glsl", 30);
  EXPECT_EQ(reload().rebuilt.size(), 1U);
  EXPECT_EQ(resultOf(a), 2U);
  // An older copy put in place of it.
  write("a.comp.glsl", giving("3u"));
  age("a.comp.glsl", 90);
  EXPECT_EQ(reload().rebuilt.size(), 1U);
  write("a.comp.glsl", giving("40u"));
  age("a.comp.glsl", 90);
  EXPECT_EQ(reload().rebuilt.size(), 1U);
  EXPECT_EQ(resultOf(a), 40U);
}

TEST_F(ProgramReload, AChangeWithinOneTickOfTheFilesClockIsSeen) {
  write("a.comp.glsl", giving("1u"));
  const fs::file_time_type tick = fs::last_write_time(root_ / "a.comp.glsl");
  const Program& a = cache_.compute("a.comp.glsl");
  write("a.comp.glsl", giving("2u"));
  fs::last_write_time(root_ / "a.comp.glsl", tick);
  EXPECT_EQ(reload().rebuilt.size(), 1U);
  EXPECT_EQ(resultOf(a), 2U);
}

TEST_F(ProgramReload, ATouchWithoutAChangeBuildsNothing) {
  write("a.comp.glsl", giving("1u"));
  age("a.comp.glsl", 60);
  const uint32_t id = cache_.compute("a.comp.glsl").id();
  age("a.comp.glsl", 30);
  expectNothingHappens();
  EXPECT_EQ(cache_.compute("a.comp.glsl").id(), id);
}

TEST_F(ProgramReload, AnIncludedFileChangesAllProgramsThatIncludeIt) {
  write("value.glsl", "const uint kValue = 1u;\n");
  write("between.glsl", "#include \"value.glsl\"\n");
  for (const char* name : {"a.comp.glsl", "b.comp.glsl"})
    write(name, "#include \"between.glsl\"\n" + giving("kValue + ADDED"));
  write("c.comp.glsl", giving("1u"));
  const Program &a = cache_.compute("a.comp.glsl", {{"ADDED", "0u"}}),
                &b = cache_.compute("b.comp.glsl", {{"ADDED", "100u"}});
  cache_.compute("c.comp.glsl");
  write("value.glsl", "const uint kValue = 7u;\n");
  EXPECT_THAT(reload().rebuilt, ElementsAre("a.comp.glsl (ADDED=0u)", "b.comp.glsl (ADDED=100u)"));
  EXPECT_EQ(resultOf(a), 7U);
  EXPECT_EQ(resultOf(b), 107U);
}

TEST_F(ProgramReload, ABrokenProgramKeepsTheOldOneUntilItIsMended) {
  write("value.glsl", "uint value() { return 1u; }\n");
  write("a.comp.glsl", "#include \"value.glsl\"\n" + giving("value()"));
  const Program& a = cache_.compute("a.comp.glsl");
  write("value.glsl", "// a line\nuint value() { return nothing; }\n");
  const ProgramCache::Reload broken = reload();
  EXPECT_THAT(broken.rebuilt, IsEmpty());
  EXPECT_THAT(broken.failures, ElementsAre(AllOf(HasSubstr("a.comp.glsl"), HasSubstr("value.glsl:2"))));
  EXPECT_EQ(resultOf(a), 1U);
  expectNothingHappens();  // told once
  write("value.glsl", "uint value() { return 3u; }\n");
  EXPECT_THAT(reload().rebuilt, ElementsAre("a.comp.glsl"));
  EXPECT_EQ(resultOf(a), 3U);
}

TEST_F(ProgramReload, AMistakeThatIsTakenBackIsSaidToBeMended) {
  write("a.comp.glsl", giving("1u"));
  const Program& a = cache_.compute("a.comp.glsl");
  write("a.comp.glsl", giving("nothing"));
  EXPECT_THAT(reload().failures, ElementsAre(HasSubstr("a.comp.glsl:3")));
  write("a.comp.glsl", giving("1u"));
  EXPECT_THAT(reload().rebuilt, ElementsAre("a.comp.glsl"));
  EXPECT_EQ(resultOf(a), 1U);
}

TEST_F(ProgramReload, AProgramThatDoesNotLinkKeepsTheOldOne) {
  write("a.comp.glsl", giving("1u"));
  const Program& a = cache_.compute("a.comp.glsl");
  write("a.comp.glsl", kStart + "uint value();\nvoid main() { result[0] = value(); }\n");
  EXPECT_THAT(reload().failures, ElementsAre(HasSubstr("a.comp.glsl")));
  EXPECT_EQ(resultOf(a), 1U);
}

TEST_F(ProgramReload, ADeletedFileIsSaidAndTheOldProgramKept) {
  write("value.glsl", "uint value() { return 1u; }\n");
  write("a.comp.glsl", "#include \"value.glsl\"\n" + giving("value()"));
  const Program& a = cache_.compute("a.comp.glsl");
  fs::remove(root_ / "value.glsl");
  EXPECT_THAT(reload().failures, ElementsAre(AllOf(HasSubstr("value.glsl"), HasSubstr("a.comp.glsl:1"))));
  EXPECT_EQ(resultOf(a), 1U);
  expectNothingHappens();
  write("value.glsl", "uint value() { return 4u; }\n");
  EXPECT_THAT(reload().rebuilt, ElementsAre("a.comp.glsl"));
  EXPECT_EQ(resultOf(a), 4U);
}

TEST_F(ProgramReload, AFileThatIsIncludedBeforeItIsThereIsAwaited) {
  write("a.comp.glsl", giving("1u"));
  const Program& a = cache_.compute("a.comp.glsl");
  write("a.comp.glsl", "#include \"later.glsl\"\n" + giving("later()"));
  age("a.comp.glsl", 60);
  EXPECT_THAT(reload().failures, ElementsAre(HasSubstr("later.glsl")));
  write("later.glsl", "uint later() { return 6u; }\n");
  EXPECT_THAT(reload().rebuilt, ElementsAre("a.comp.glsl"));
  EXPECT_EQ(resultOf(a), 6U);
}

TEST_F(ProgramReload, AFileThatIsPutBackAsItWasIsSaidToBeMended) {
  write("a.comp.glsl", giving("1u"));
  age("a.comp.glsl", 60);
  const fs::file_time_type before = fs::last_write_time(root_ / "a.comp.glsl");
  cache_.compute("a.comp.glsl");
  fs::rename(root_ / "a.comp.glsl", root_ / "away");
  EXPECT_EQ(reload().failures.size(), 1U);
  fs::rename(root_ / "away", root_ / "a.comp.glsl");
  ASSERT_EQ(fs::last_write_time(root_ / "a.comp.glsl"), before);
  EXPECT_THAT(reload().rebuilt, ElementsAre("a.comp.glsl"));
}

TEST_F(ProgramReload, AProgramThatNeverWasIsNoBusinessOfReloading) {
  write("a.comp.glsl", giving("nothing"));
  EXPECT_THROW(cache_.compute("a.comp.glsl"), std::runtime_error);
  context().takeDebugMessages();
  expectNothingHappens();
  write("a.comp.glsl", giving("1u"));
  expectNothingHappens();
  EXPECT_EQ(resultOf(cache_.compute("a.comp.glsl")), 1U);
}

TEST_F(ProgramReload, UniformsAreFoundWhereTheNewProgramHasThem) {
  write("a.comp.glsl", kStart +
                           "layout(location = 3) uniform uint one;\nlayout(location = 8) uniform uint two;\n"
                           "void main() { result[0] = one + 10u * two; }\n");
  const Program& a = cache_.compute("a.comp.glsl");
  a.set("one", 1U), a.set("two", 2U);
  EXPECT_EQ(resultOf(a), 21U);
  write("a.comp.glsl", kStart +
                           "layout(location = 8) uniform uint one;\nlayout(location = 3) uniform uint two;\n"
                           "void main() { result[0] = one + 10u * two; }\n");
  EXPECT_EQ(reload().rebuilt.size(), 1U);
  a.set("one", 3U), a.set("two", 4U);
  EXPECT_EQ(resultOf(a), 43U);
}

TEST_F(ProgramReload, ProgramsFromEmbeddedSourcesFollowATreeOnceThereIsOne) {
  unsetenv("LIMEN_SHADER_ROOT");
  if (!shaderRoot().empty()) GTEST_SKIP() << "this build embeds no shaders";
  const Program& a = cache_.compute("embedded.comp.glsl");
  EXPECT_EQ(resultOf(a), 5U);
  expectNothingHappens();
  setShaderRoot(root_);
  write("embedded.comp.glsl", giving("5u"));
  expectNothingHappens();
  write("embedded.comp.glsl", giving("6u"));
  EXPECT_THAT(reload().rebuilt, ElementsAre("embedded.comp.glsl"));
  EXPECT_EQ(resultOf(a), 6U);
}

}  // namespace
}  // namespace limen::gl
