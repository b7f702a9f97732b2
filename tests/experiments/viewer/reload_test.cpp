// SPDX-License-Identifier: BSD-3-Clause
// Shaders that are edited while the viewer runs.
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

#include "renderer/gl/shader_source.h"
#include "tests/experiments/viewer/viewer_fixture.h"

namespace limen::viewer {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ShaderReload : public ViewerTest {
 protected:
  ShaderReload() {
    if (const char* root = std::getenv("LIMEN_SHADER_ROOT")) rootBefore_ = root;
  }
  ~ShaderReload() override {
    viewer_.reset();
    if (rootBefore_)
      gl::setShaderRoot(*rootBefore_);
    else
      unsetenv("LIMEN_SHADER_ROOT");
  }

  /// The tree's shaders in a place of their own.
  fs::path copyShaders() {
    const fs::path root = folder_ / "shaders", source = LIMEN_SOURCE_DIR;
    for (const char* folder : {"renderer", "perception", "experiments"})
      for (const auto& entry : fs::recursive_directory_iterator(source / folder))
        if (entry.path().extension() == ".glsl" ||
            entry.path().extension() == ".h") {  // bindings are headers
          const fs::path to = root / fs::relative(entry.path(), source);
          fs::create_directories(to.parent_path());
          fs::copy_file(entry.path(), to);
        }
    return root;
  }
  static std::string read(const fs::path& path) {
    std::stringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  }
  std::optional<std::string> rootBefore_;

  std::string hash() const { return viewer_->state().shown->rendered.at(0).productHash; }
};

TEST_F(ShaderReload, AChangeIsShownAndAMistakeIsSaidWhileTheOldProgramRunsOn) {
  const fs::path root = copyShaders();
  gl::setShaderRoot(root.string());
  open(smallSetup("soft_shadows/hard"), root.string());
  rest();
  const std::string own = hash();

  const fs::path file = root / "renderer/techniques/soft_shadows/hard/hard.comp.glsl";
  const std::string text = read(file);
  ASSERT_THAT(text, HasSubstr("float visibilityOf"));
  std::ofstream(file) << text << "\nthis is no GLSL\n";
  ASSERT_TRUE(drawUntil([&] { return !viewer_->state().shaderFailure.empty(); }));
  EXPECT_THAT(viewer_->state().shaderFailure, HasSubstr("hard.comp.glsl:"));
  EXPECT_EQ(hash(), own);
  ViewSetup setup = viewer_->state().setup;
  setup.sizePx = {32, 24};  // the old program goes on
  viewer_->show(setup);
  rest();
  EXPECT_EQ(viewer_->state().shown->rendered.at(0).error, "");
  setup.sizePx = {40, 30};
  viewer_->show(setup);
  rest();
  EXPECT_EQ(hash(), own);

  // Fixed and changed: light where there was shadow, and the other way round, wherever the map is looked at.
  const std::shared_ptr<const Image> was = viewer_->state().shown->rendered.at(0).product;
  std::string turned = text;
  const std::string answer = "? 0.0 : 1.0";
  ASSERT_NE(turned.find(answer), std::string::npos);
  turned.replace(turned.find(answer), answer.size(), "? 1.0 : 0.0");
  std::ofstream(file) << turned;
  ASSERT_TRUE(drawUntil([&] { return hash() != own; }));
  EXPECT_EQ(viewer_->state().shaderFailure, "");
  rest();
  const Image& is = *viewer_->state().shown->rendered.at(0).product;
  int changed = 0;
  for (size_t i = 0; i < is.data.size(); ++i) {
    if (is.data[i] == was->data[i]) continue;
    ++changed;
    EXPECT_EQ(is.data[i], 1.0F - was->data[i]);
  }
  EXPECT_GT(changed, 100);
  std::ofstream(file) << text;
  ASSERT_TRUE(drawUntil([&] { return hash() == own; }));
}

}  // namespace
}  // namespace limen::viewer
