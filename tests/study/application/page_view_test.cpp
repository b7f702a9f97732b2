// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/page_view.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "experiments/base/image.h"
#include "renderer/gl/window_context.h"
#include "renderer/window/ui_window.h"
#include "study/application/lettering.h"
#include "study/application/question.h"
#include "study/application/screens.h"
#include "tests/renderer/window/x_server.h"

namespace limen::study {
namespace {

const std::string kLongText =
    "You will see short films of a surface that comes nearer. In some of them its shape changes for a "
    "moment. "
    "Look at the tip of the surface, where the arrow points.\n\n- Keep your head still.\n- Blink between the "
    "films, not in them.\n\nThere is no right way to look; tell us what you see. It does not matter if you "
    "see "
    "nothing at all in many of them: that is how the films were made.";

// Every kind of page that people see, with the longest words that are likely.
std::vector<std::pair<std::string, Page>> pages() {
  std::vector<std::pair<std::string, Page>> all;
  const auto add = [&](const std::string& name, const PageScreen& screen) {
    all.emplace_back(name, screen.page(0));
  };
  Page wait;
  wait.status = "One moment, please";
  all.emplace_back("wait", wait);
  TextScreen::Setting text;
  text.title = "What to do";
  text.text = kLongText;
  text.progress = 0.4;
  text.footer = "45 of 112";
  text.atLeastS = 20;
  add("text", TextScreen(text));
  add("consent", ConsentScreen(kLongText + "\n\n" + kLongText + "\n\n" + kLongText));
  FormScreen form({{"age",
                    "How old are you?",
                    {"18 to 25 years", "26 to 35 years", "36 to 45 years", "46 to 55 years", "56 to 65 years",
                     "older", "I would rather not say"}}});
  add("form", form);
  form.shown(0);
  form.take({window::Device::Keyboard, '3', 0, 0, 1}, {});
  add("form_review", form);
  PauseScreen pause("", "The picture could not be shown: another window is in front.");
  add("pause", pause);
  pause.shown(0);
  pause.take({window::Device::Keyboard, 's', 0, 0, 1}, {});
  add("pause_stop", pause);
  TaskSetting task;
  task.answers = {"yes", "no"};
  task.question = "Did you notice that the surface changed its shape?";
  task.severity =
      Scale{"How strong was the strongest change?", {"hardly visible", "visible", "clearly visible"}};
  task.confidence = Scale{
      "How sure are you?",
      {"guessed", "very unsure", "rather unsure", "undecided", "rather sure", "sure", "absolutely certain"}};
  QuestionScreen question(task, 0);
  add("question", question);
  question.shown(0);
  question.take({window::Device::Keyboard, 'y', 0, 0, 1}, {});
  add("severity", question);
  question.shown(2);
  question.take({window::Device::Keyboard, '1', 0, 0, 3}, {});
  question.shown(4);
  question.take({window::Device::Keyboard, window::kKeyRight, 0, 0, 5}, {});
  add("confidence", question);
  task.type = Task::Alternative;
  task.alternatives = 4;
  task.answers = {"upper left", "upper right", "lower left", "lower right"};
  add("alternatives", QuestionScreen(task, 0));
  return all;
}

double share(const Image& image, const TargetRect& rect, glm::vec3 background) {
  int other = 0, count = 0;
  for (int y = static_cast<int>(rect.y0); y < static_cast<int>(rect.y1); ++y)
    for (int x = static_cast<int>(rect.x0); x < static_cast<int>(rect.x1); ++x, ++count)
      other += std::abs(image.at(x, y, 1) - background.y) > 0.3F;
  return static_cast<double>(other) / count;
}

// LIMEN_PAGES names a folder for pictures of all of them, for people to look at.
TEST(PageView, EveryPageFitsIntoCommonWindows) {
  test::openWindowsOnOneServer();
  const char* folder = std::getenv("LIMEN_PAGES");
  struct Case {
    glm::ivec2 sizePx;
    float scale;
  };
  for (const Case& shape :
       {Case{{1280, 1024}, 1}, Case{{1024, 768}, 1}, Case{{2560, 1440}, 2}, Case{{1280, 1024}, 2}}) {
    window::UiWindowOptions options;
    options.sizePx = shape.sizePx;
    options.scale = shape.scale;
    window::UiWindow window(options);
    ASSERT_EQ(window.sizePx(), shape.sizePx);
    const PageStyle style{window.fonts(), window.scale(), glm::vec3(0.25F), false};
    for (const auto& [name, page] : pages()) {
      const std::string file = name + "_" + std::to_string(shape.sizePx.x) + "_" +
                               std::to_string(static_cast<int>(shape.scale)) + ".png";
      SCOPED_TRACE(file);
      PageLayout layout;
      window.draw(style.background, [&, &shown = page] {
        layout = drawPage(shown, glm::vec2(shape.sizePx), {-1, -1}, style);
      });
      const Image image = window.readBack();
      window.show();
      if (folder) writePng((std::filesystem::path(folder) / file).string(), image);
      EXPECT_TRUE(layout.fits);
      ASSERT_EQ(layout.targets.size(), page.buttons.size());
      for (size_t i = 0; i < layout.targets.size(); ++i) {
        const TargetRect& rect = layout.targets[i];
        EXPECT_TRUE(rect.x0 >= 0 && rect.y0 >= 0 && rect.x1 <= shape.sizePx.x && rect.y1 <= shape.sizePx.y);
        // 40 px are 1 cm on a display of 96 dpi, the least for a target that is hit without aiming.
        EXPECT_GE(rect.y1 - rect.y0, 40.0F);
        EXPECT_GE(rect.x1 - rect.x0, 40.0F);
        if (page.buttons[i].enabled) {
          EXPECT_GT(share(image, rect, style.background), 0.003) << "no lettering";
        }
        for (size_t j = 0; j < i; ++j) {
          const TargetRect& other = layout.targets[j];
          EXPECT_TRUE(rect.x0 >= other.x1 || other.x0 >= rect.x1 || rect.y0 >= other.y1 ||
                      other.y0 >= rect.y1)
              << "targets overlap";
        }
      }
    }
    window.context().checkDebugMessages();
  }
}

TEST(PageView, TextsWrappedInAFileBecomeParagraphs) {
  EXPECT_EQ(unwrapped("one\ntwo\n\nthree \n- four\n- five\nsix\n"), "one two\n\nthree\n- four\n- five six");
}

}  // namespace
}  // namespace limen::study
