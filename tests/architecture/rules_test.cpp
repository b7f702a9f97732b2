// SPDX-License-Identifier: BSD-3-Clause
// Planted violations: what the rules must find, and what they must let pass.
#include "tests/architecture/rules.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>

#include "tests/architecture/modules.h"

namespace limen::architecture {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::UnorderedElementsAre;

class PlantedTree : public testing::Test {
 protected:
  PlantedTree() : root_(fs::temp_directory_path() / ("limen_planted_" + std::to_string(getpid()))) {
    fs::create_directories(root_);
  }
  ~PlantedTree() override { fs::remove_all(root_); }

  void plant(const std::string& path, const std::string& text) {
    fs::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << text;
  }

  fs::path root_;
};

TEST_F(PlantedTree, AllowedIncludesPass) {
  plant("renderer/techniques/soft_shadows/hard/hard.cpp",
        "#include \"renderer/frame/frame.h\"\n#include \"perception/metrics/metric.h\"\n#include <vector>\n"
        "#include \"renderer/techniques/soft_shadows/hard/hard.h\"\n#include \"imgui.h\"\n");
  plant("renderer/references/area/area.cpp", "#include \"renderer/techniques/technique.h\"\n");
  plant("renderer/gl/context.cpp", "#include <epoxy/egl.h>\n");
  plant("experiments/runner.cpp", "#include \"experiments/store/store.h\"\n#include <glm/glm.hpp>\n");
  plant("analysis/sweep/report.cpp",
        "#include \"experiments/store/store.h\"\n#include \"experiments/base/text.h\"\n");
  plant("tests/renderer/inside_test.cpp", "#include \"renderer/techniques/soft_shadows/hard/hard.h\"\n");
  EXPECT_THAT(checkIncludes(root_), IsEmpty());
}

TEST_F(PlantedTree, AnIncludeAgainstTheDirectionIsFoundWithItsLine) {
  plant("renderer/gl/texture.h", "// first line\n#  include \"renderer/scene/scene.h\"\n");
  plant("analysis/sweep/report.cpp", "#include \"experiments/executor.h\"\n");
  plant("perception/flip.comp.glsl", "#include \"renderer/frame/frame.glsl\"\n");
  EXPECT_THAT(checkIncludes(root_),
              ElementsAre(HasSubstr("analysis/sweep/report.cpp:1: includes experiments/executor.h"),
                          HasSubstr("perception/flip.comp.glsl:1:"), HasSubstr("renderer/gl/texture.h:2:")));
}

TEST_F(PlantedTree, ARelativeIncludeIsSeenThrough) {
  plant("renderer/scene/mesh.cpp", "#include \"../gl/buffer.h\"\n#include \"mesh.h\"\n");
  EXPECT_THAT(checkIncludes(root_), ElementsAre(HasSubstr("mesh.cpp:1: includes ../gl/buffer.h")));
}

TEST_F(PlantedTree, AnInsideOfAnotherModuleIsFound) {
  plant("experiments/runner.cpp", "#include \"renderer/techniques/soft_shadows/hard/hard.h\"\n");
  plant("study/trial.cpp", "#include \"perception/metrics/flip/kernel.h\"\n");
  EXPECT_THAT(checkIncludes(root_), ElementsAre(HasSubstr("an inside of renderer/techniques"),
                                                HasSubstr("an inside of perception")));
}

TEST_F(PlantedTree, AReferenceSharesOnlyTheInterfaceOfTechniques) {
  plant("renderer/references/area.cpp", "#include \"renderer/techniques/shared.h\"\n");
  EXPECT_THAT(checkIncludes(root_), ElementsAre(HasSubstr("technique.h alone")));
}

TEST_F(PlantedTree, OpenGlInAModuleWithoutItIsFound) {
  plant("analysis/answer_fits/fit.cpp", "#include <epoxy/gl.h>\n#include <glm/glm.hpp>\n");
  plant("experiments/base/window.h", "#include <GLFW/glfw3.h>\n");
  plant("renderer/scene/upload.cpp", "#include <GL/gl.h>\n");
  EXPECT_THAT(checkIncludes(root_), SizeIs(3));
}

TEST_F(PlantedTree, AnIncludeOfATestIsFound) {
  plant("experiments/base/text.cpp", "#include \"tests/experiments/base/helper.h\"\n");
  EXPECT_THAT(checkIncludes(root_), ElementsAre(HasSubstr("only tests use tests")));
}

TEST_F(PlantedTree, AMissingLicenceLineIsFound) {
  plant("experiments/base/good.h", "// SPDX-License-Identifier: BSD-3-Clause\n#pragma once\n");
  plant("experiments/base/late.cpp", "\n// SPDX-License-Identifier: BSD-3-Clause\n");
  plant("tests/experiments/base/other.cpp", "// SPDX-License-Identifier: MIT\n");
  plant("renderer/frame/empty.glsl", "");
  plant("results/scratch.cpp", "int x;\n");
  EXPECT_THAT(checkLicenceLines(root_), UnorderedElementsAre(HasSubstr("experiments/base/late.cpp"),
                                                             HasSubstr("tests/experiments/base/other.cpp"),
                                                             HasSubstr("renderer/frame/empty.glsl")));
}

TEST_F(PlantedTree, AFileThatIsWrittenByItselfIsFound) {
  plant("experiments/store/good.cpp", "std::ifstream in(path);\nstd::fopen(path.c_str(), \"rb\");\n");
  plant("analysis/sweep/stream.cpp", "int x;\nstd::ofstream out(path);\n");
  plant("study/export/copy.cpp", "fs::copy_file(a, b);\n");
  plant("renderer/frame/open.cpp", "auto* file = fopen(path.c_str(), \"wb\");\n");
  plant("tests/study/free.cpp", "std::ofstream out(path);\n");
  EXPECT_THAT(checkFileWriting(root_), UnorderedElementsAre(HasSubstr("analysis/sweep/stream.cpp:2"),
                                                            HasSubstr("study/export/copy.cpp:1"),
                                                            HasSubstr("renderer/frame/open.cpp:1")));
}

TEST_F(PlantedTree, AShaderThatNoListNamesIsFound) {
  plant("renderer/frame/CMakeLists.txt",
        "limen_shaders(limen_frame\n  a.glsl parts/b.glsl\n  c.glsl)\nlimen_technique(x hard)\n");
  for (const char* file :
       {"a.glsl", "parts/b.glsl", "c.glsl", "hard/hard.comp.glsl", "hard/soft.comp.glsl", "aa.glsl"})
    plant(std::string("renderer/frame/") + file, "void main() {}\n");
  EXPECT_THAT(checkShaderLists(root_), UnorderedElementsAre(HasSubstr("renderer/frame/hard/soft.comp.glsl:"),
                                                            HasSubstr("renderer/frame/aa.glsl:")));
}

TEST(TargetRules, ALinkAgainstTheDirectionIsFoundInsideGeneratorExpressions) {
  const auto targets = readTargets(
      "limen_options|.|\n"
      "limen_base|experiments/base|limen_options;fmt::fmt\n"
      "limen_gl|renderer/gl|limen_base;$<LINK_ONLY:PkgConfig::EPOXY>\n"
      "limen_scene|renderer/scene|limen_base;$<LINK_ONLY:limen_gl>\n"
      "limen-sweep|experiments|$<LINK_LIBRARY:WHOLE_ARCHIVE,limen_scene,limen_gl>\n"
      "test_scene|tests/renderer|limen_scene;limen-sweep\n");
  EXPECT_THAT(
      checkTargets(targets),
      UnorderedElementsAre(HasSubstr("limen_scene links limen_gl; renderer/scene may use experiments/base"),
                           HasSubstr("limen_scene links limen_gl; renderer/scene must not know OpenGL"),
                           HasSubstr("limen_scene links PkgConfig::EPOXY")));
}

TEST(TargetRules, OpenGlThatReachesAnalysisThroughAnotherTargetIsFound) {
  const auto targets = readTargets(
      "limen_store|experiments/store|SQLite::SQLite3;limen_charts\n"
      "limen_charts|experiments/base|/usr/lib/libGL.so\n"
      "limen-analyse|analysis|limen_store\n");
  EXPECT_THAT(checkTargets(targets), SizeIs(3)) << "one for each module that GL reaches";
}

TEST(TargetRules, ATargetInAnUnknownFolderIsFound) {
  EXPECT_THAT(checkTargets(readTargets("limen_extra|extra|\n")),
              ElementsAre(HasSubstr("extra is no known module")));
}

TEST(TargetRules, OnlyOpenGlAndWindowLibrariesCountAsGl) {
  for (const char* name : {"epoxy/gl.h", "GLFW/glfw3.h", "EGL/egl.h", "GL/gl.h", "OpenGL::EGL", "libGL.so.1",
                           "glfw", "PkgConfig::EPOXY", "limen_gl", "libGLX.so.0", "libOpenGL.so.0", "-lGL"}) {
    EXPECT_TRUE(namesGl(name)) << name;
  }
  for (const char* name : {"glm/glm.hpp", "libglib-2.0.so.0", "glob.h", "fmt::fmt", "yaml-cpp",
                           "libOpenImageIO.so.2.4", "signal.h", "legend.h", "GTest::gtest"}) {
    EXPECT_FALSE(namesGl(name)) << name;
  }
}

TEST(PackageTable, ARowThatDiffersIsMissingOrIsTooMuchIsFound) {
  const std::string packages = "# comment\n\ng++    build  compiler of C++\ncmake  build  build\n";
  const std::string head =
      "| Package | When | What for |\n| --- | --- | --- |\n| `g++` | build | compiler of C++ |\n";
  EXPECT_THAT(checkPackageTable(head + "| `cmake` | build | build |\n", packages), IsEmpty());
  EXPECT_THAT(checkPackageTable(head + "| `cmake` | run | build |\n", packages), SizeIs(1));
  EXPECT_THAT(checkPackageTable(head, packages), SizeIs(1));
  EXPECT_THAT(checkPackageTable(head + "| `cmake` | build | build |\n| `git` | build | x |\n", packages),
              SizeIs(1));
}

}  // namespace
}  // namespace limen::architecture
