// SPDX-License-Identifier: BSD-3-Clause
// Techniques are chosen and their parameters set to both ends by the mouse. By default a few of them; all
// where LIMEN_EVERY_CONTROL is set, which takes minutes on a GPU and an hour without.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "renderer/scene/scene.h"
#include "tests/experiments/viewer/viewer_fixture.h"

namespace limen::viewer {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Whether the `index`-th technique is looked at.
bool looksAt(size_t index, const std::string& name) {
  const char* value = std::getenv("LIMEN_EVERY_CONTROL");
  int part = 0, parts = 0;
  if (value && std::sscanf(value, "%d/%d", &part, &parts) == 2 && parts > 0)
    return static_cast<int>(index % static_cast<size_t>(parts)) == part - 1;
  return name == "soft_shadows/hard" || name == "lod/blend" || name == "test/alternatives";
}

/// One that has what the technique needs.
std::string sceneFor(const techniques::TechniqueInfo& info) {
  for (const char* name : {"sphere_grid", "lod/terrain", "lod/object", "palm", "street_light", "stream"}) {
    if (!scene::SceneRegistry::instance().find(name)) continue;
    const std::set<std::string> traits = scene::buildScene(name, {}).traits();
    if (std::all_of(info.needs.begin(), info.needs.end(),
                    [&](const std::string& need) { return traits.count(need); }))
      return name;
  }
  return {};
}

class EveryControl : public ViewerTest {
 protected:
  /// Fails where the picture is wrong; a refusal with a way out is none.
  void expectSound(const std::string& what) {
    const RenderResult& shown = *viewer_->state().shown;
    EXPECT_EQ(shown.error, "") << what;
    for (const Rendered& one : shown.rendered) {
      EXPECT_EQ(one.failure, "") << what;
      EXPECT_THAT(one.error, Not(HasSubstr("OpenGL driver reports"))) << what;
      EXPECT_THAT(one.error, Not(HasSubstr("does not compile"))) << what;
    }
  }

  /// Chooses the alternatives under which a parameter exists; false if they conflict with defaults.
  bool chooseAlternatives(const DeclaredAt& at) {
    ViewSetup setup = viewer_->state().setup;
    for (const auto& [path, kind] : at.when)
      setParameter(setup.technique, techniqueParameters(setup.technique.name), path, kind);
    try {
      viewer_->show(setup);
    } catch (const Error&) {
      return false;
    }
    rest();
    return true;
  }
  ParameterValue now(const DeclaredAt& at) {
    return valueAt(viewer_->state().setup.technique, at.path, *at.parameter);
  }

  /// Parameters within others may start folded.
  void openGroups(const std::string& control) {
    const std::string first = "technique.";
    for (size_t dot = control.find('.', first.size()); dot != std::string::npos;
         dot = control.find('.', dot + 1)) {
      const std::string above = control.substr(0, dot);
      const bool choice = viewer_->controls().find(above + ".fold") != nullptr;
      if (!isOpen(above)) click(choice ? above + ".fold" : above);
      draw();
    }
  }
  bool isOpen(const std::string& group) {
    const auto& all = viewer_->controls().all();
    return std::any_of(all.begin(), all.end(), [&](const auto& one) {
      return one.first.rfind(group + ".", 0) == 0 && one.first != group + ".fold" &&
             one.first != group + ".default";
    });
  }

  void dragToEnds(const DeclaredAt& at, const std::string& what) {
    const Parameter& parameter = *at.parameter;
    const std::string control = "technique." + at.path;
    openGroups(control);
    for (const float end : {0.0F, 1.0F}) {
      if (end > 0.5F && costly(parameter)) continue;
      // From one end to the other, and past it.
      drag(along(control, 0.5F), along(control, end) + glm::vec2(end > 0.5F ? 40.0F : -40.0F, 0.0F));
      const double expected = end > 0.5F ? *parameter.maximum : *parameter.minimum;
      const ParameterValue value = now(at);
      const double is = parameter.type == ParameterType::Integer
                            ? static_cast<double>(std::get<int64_t>(value))
                            : std::get<double>(value);
      EXPECT_EQ(is, expected) << what;
      rest();
      expectSound(what + " = " + toText(value));
    }
  }

  void choose(const DeclaredAt& at, const ParameterValue& value, const std::string& what) {
    ViewSetup setup = viewer_->state().setup;
    setParameter(setup.technique, techniqueParameters(setup.technique.name), at.path, value);
    try {
      viewer_->show(setup);
    } catch (const Error&) {
      return;  // conflicts with the others at their default
    }
    rest();
    expectSound(what + " = " + toText(value));
  }

  void throughItsEnds(const techniques::TechniqueInfo& info) {
    for (const DeclaredAt& at : flatten(info.parameters)) {
      const Parameter& parameter = *at.parameter;
      const std::string what = info.name + ", " + at.path;
      if (std::getenv("LIMEN_EVERY_CONTROL")) std::printf("%s\n", what.c_str()), std::fflush(stdout);
      if (!chooseAlternatives(at)) continue;
      switch (parameter.type) {
        case ParameterType::Boolean:
          openGroups("technique." + at.path);
          click("technique." + at.path);
          EXPECT_EQ(toText(now(at)), std::get<bool>(parameter.defaultValue) ? "false" : "true") << what;
          rest();
          expectSound(what);
          break;
        case ParameterType::Integer:
          if (!parameter.allowed.empty()) {
            for (const int64_t number : {parameter.allowed.front(), parameter.allowed.back()})
              choose(at, number, what);
            break;
          }
          [[fallthrough]];
        case ParameterType::Real:
          dragToEnds(at, what);
          break;
        case ParameterType::Choice:
          for (const std::string& choice : {parameter.choices.front(), parameter.choices.back()})
            choose(at, choice, what);
          break;
        default:
          break;
      }
      ViewSetup setup = viewer_->state().setup;
      setup.technique.given.clear();
      viewer_->show(setup);
    }
  }

  /// The upper end of a count of samples or frames takes minutes of any machine's time.
  static bool costly(const Parameter& parameter) {
    return parameter.type == ParameterType::Integer && *parameter.maximum > 256.0 &&
           (parameter.name == "samples" || parameter.name == "frames" || parameter.name == "settle_frames");
  }
};

TEST_F(EveryControl, TechniquesAreChosenByHandAndTheirParametersGoToBothEnds) {
  ViewSetup setup = smallSetup("soft_shadows/pcf", "sphere_grid");
  setup.sizePx = {24, 18};
  open(setup, {}, {900, 2600});
  rest();
  size_t index = 0;
  for (const auto& [name, info] : techniques::TechniqueRegistry::instance().all()) {
    if (name == "test/slow_reference") continue;
    // Each change starts a search that takes a software renderer a minute; its parameters' ends are in
    // scene_needs_test.cpp and reflection_needs_test.cpp.
    if (name.ends_with("/scene_needs")) continue;
    if (!looksAt(index++, name)) continue;
    SCOPED_TRACE(name);
    const std::string scene = sceneFor(info);
    ASSERT_NE(scene, "") << "no scene here has what " << name << " needs";
    ViewSetup fitting = viewer_->state().setup;
    fitting.scene = {scene, {}};
    fitting.reference.reset();
    fitting.second.reset();
    viewer_->show(fitting);
    rest();
    click("technique");
    draw();
    ASSERT_TRUE(viewer_->controls().find("technique/" + name)) << "not in the list: " << name;
    // The list scrolls; what is far down is reached through the filter.
    ui_->type(name);
    draw();
    draw();
    click("technique/" + name);
    ASSERT_EQ(viewer_->state().setup.technique.name, name);
    fitting = viewer_->state().setup;
    fitting.reference.reset();
    viewer_->show(fitting);
    rest();
    expectSound(name);
    EXPECT_EQ(viewer_->state().shown->rendered.at(0).error, "") << name;
    throughItsEnds(info);
  }
}

}  // namespace
}  // namespace limen::viewer
