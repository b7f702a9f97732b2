// SPDX-License-Identifier: BSD-3-Clause
// Units and blocks stand once, in headers that C++ and GLSL share.
#include "tests/architecture/bindings.h"

#include <gmock/gmock.h>

#include <map>

namespace limen::architecture {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TEST(Bindings, TheTreeNamesEveryUnit) { EXPECT_THAT(checkBindings(LIMEN_SOURCE_DIR), IsEmpty()); }

TEST(Bindings, ANumberInALayoutIsFound) {
  EXPECT_THAT(checkLayouts("a.glsl", "\nlayout(binding = 3) uniform sampler2D map;\n"),
              ElementsAre(HasSubstr("a.glsl:2")));
  EXPECT_THAT(checkLayouts("a.glsl", "layout(std430, binding=0) buffer B { uint b[]; };"), SizeIs(1));
  EXPECT_THAT(checkLayouts("a.glsl", "layout(r32f, binding = 1) uniform image2D i;"), SizeIs(1));
  EXPECT_THAT(checkLayouts("a.glsl", "#define SUMS_UNIT 2\n"), SizeIs(1));
  EXPECT_THAT(checkLayouts("a.glsl",
                           "layout(binding = kMapUnit) uniform sampler2D map;\n"
                           "#define SUMS_UNIT kMapUnit\nlayout(local_size_x = 8) in;\n"),
              IsEmpty());
}

TEST(Bindings, ANumberInACallThatBindsIsFound) {
  for (const char* line :
       {"map.bindTexture(3);", "out->bindImage(0, gl::Access::Write);", "in.bindStorage( 1);",
        "block.bindUniform(0);", "glBindTextureUnit(0, id);", "picture.bind(0);", "sums->bind(2U);",
        "view.bindTexture(3 * i + 1);", "glBindBufferBase(GL_UNIFORM_BUFFER, 4, id);"})
    EXPECT_THAT(checkBindCalls("a.cpp", line), SizeIs(1)) << line;
  for (const char* line :
       {"map.bindTexture(kMapUnit);", "map.bindTexture(kFirstUnit + 1);", "layers.bind(unit);",
        "glBindBufferBase(GL_UNIFORM_BUFFER, binding, id_);", "statement.bind(3, \"text\");"})
    EXPECT_THAT(checkBindCalls("a.cpp", line), IsEmpty()) << line;
}

TEST(Bindings, UnitsBeyondWhatDriversGrantAreFound) {
  EXPECT_THAT(
      checkUnits("a.h",
                 "const uint kOutImage = 7u;\nconst uint kMapUnit = 15u;\nconst uint kBuffer = 40u;\n"),
      IsEmpty());
  EXPECT_THAT(checkUnits("a.h", "const uint kOutImage = 8u;"), SizeIs(1));
  EXPECT_THAT(checkUnits("a.h", "const uint kMapUnit = 16u;"), SizeIs(1));
}

TEST(Bindings, AHeaderFirstIncludedWithinAConditionIsFound) {
  std::map<std::string, std::string> files{{"a_bindings.h", "const uint kA = 0u;"},
                                           {"part.glsl", "#include \"a_bindings.h\"\n"},
                                           {"root.glsl", "#ifdef X\n#include \"part.glsl\"\n#endif\n"}};
  const auto read = [&](const std::string& path) { return files.at(path); };
  EXPECT_THAT(checkConditionalIncludes("root.glsl", read), ElementsAre(HasSubstr("a_bindings.h")));
  files["root.glsl"] = "#include \"a_bindings.h\"\n" + files["root.glsl"];
  EXPECT_THAT(checkConditionalIncludes("root.glsl", read), IsEmpty());
}

}  // namespace
}  // namespace limen::architecture
