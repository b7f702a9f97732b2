// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "renderer/window/ui_window.h"
#include "study/application/experimenter.h"
#include "study/application/page_screen.h"
#include "study/application/page_view.h"
#include "study/application/stimulus_player.h"
#include "study/session/front_end.h"

namespace limen::study {

/// The session's front end for people: screens, stimuli and questions in a window. Whatever happens to the
/// window ends in an outcome that the session can log: a stimulus that could not be seen makes the trial
/// invalid and leads to a pause, a request to stop (a signal, the window closed, the graphics context lost)
/// to a session that can be resumed.
class WindowFrontEnd : public FrontEnd {
 public:
  struct Setting {
    glm::vec3 background{0.25F};  ///< values of the screen
    bool fullScreen = false;
    nlohmann::json facts = nlohmann::json::object();  ///< added to environment()
    /// Called with "screen: NAME" when a page is on screen, and with "screen: stimulus" when one begins.
    std::function<void(const std::string& line)> announce;
    Markers* markers = nullptr;  ///< told of stimuli, questions and answers; must outlive it
    std::string screenshots;     ///< folder for a PNG of every page; "": none
  };

  /// All must outlive it; `experimenter` may be null.
  WindowFrontEnd(window::UiWindow& window, StimulusPlayer& player, SessionWatch& watch,
                 ExperimenterWindow* experimenter, Setting setting);

  ScreenResult show(const Screen& screen, const Session& session) override;
  TrialResult present(const Trial& trial, const Session& session) override;
  void feedback(bool correct) override;
  std::vector<std::string> takeNotes() override;
  nlohmann::json environment() const override;
  /// Why the session stopped although nobody requested it on screen; "" otherwise.
  const std::string& stopReason() const { return stopReason_; }

 private:
  enum class Left { Done, TimedOut, Paused, StopForNow, End, EndedByExperimenter };
  Left run(PageScreen& screen, const std::function<bool()>& timedOut = {});
  Left pause(const std::string& reason);
  bool stopAsked();
  const Words& words() const;
  std::vector<window::Input> takeInputs();
  /// Processes window events while no question is shown; false: stop the presentation.
  bool watchWindow();
  void forget();
  Left afterStop();
  std::string stoppedBy(Left left) const;
  TrialResult stopped(Left left, TrialResult result = {}) const;
  void drawNeutral(const std::string& status);
  bool prepare(const Trial& trial, const Session& session);
  TrialResult attempt(const Trial& trial, const Session& session);
  /// Tells a recorder that the question is on screen, and its answer; `marked`: how many of both it was told.
  void markQuestion(const PageScreen& screen, int64_t shownNs, int& marked);
  PageStyle style() const;
  void announce(const std::string& name);
  void screenshot(const std::string& name);

  window::UiWindow& window_;
  StimulusPlayer& player_;
  SessionWatch& watch_;
  ExperimenterWindow* experimenter_;
  Setting setting_;
  std::string stopReason_;
  const Protocol* protocol_ = nullptr;  ///< of the session that is shown
  // Since the current trial began.
  std::string loss_;
  bool pauseAsked_ = false;
  std::vector<window::Input> early_;

  int screenshots_ = 0;
  std::map<std::string, int> screenshotsOf_;
};

/// Page for a screen of the session.
std::unique_ptr<PageScreen> pageFor(const Screen& screen, const Session& session);

}  // namespace limen::study
