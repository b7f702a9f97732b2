// SPDX-License-Identifier: BSD-3-Clause
// limen-view as a user starts it: in a window under a virtual display, and without any.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <thread>

#include "experiments/base/image.h"
#include "experiments/base/video.h"
#include "tests/renderer/window/x_server.h"
#include "tests/run_program.h"

namespace limen {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* kSmall =
    "--scene sphere_grid --technique soft_shadows/pcf --reference soft_shadows/ray_traced --set "
    "reference.samples=16 "
    "--size 32x24 --window 800x600";

class ViewProgram : public testing::Test {
 protected:
  ViewProgram() : folder_(fs::temp_directory_path() / ("limen_view_" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~ViewProgram() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  fs::path folder_;
};

TEST_F(ViewProgram, WithoutADisplayItSaysHowToGetAPicture) {
  const ProgramRun run = runProgram("limen-view", "-u DISPLAY -u WAYLAND_DISPLAY");
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.text, HasSubstr("no window system"));
  EXPECT_THAT(run.text, HasSubstr("--screenshot"));
  EXPECT_EQ(std::count(run.text.begin(), run.text.end(), '\n'), 1);
}

TEST_F(ViewProgram, VideosFollowTheCamerasPath) {
  const std::string view = "limen-view --scene lod/patch --technique soft_shadows/hard --size 40x30 ";
  const ProgramRun whole = runProgram(view + "--fps 4 --seconds 1 --video " + path("a.avi"), "-u DISPLAY");
  ASSERT_EQ(whole.code, 0) << whole.text;
  EXPECT_THAT(whole.text, HasSubstr("4 frames at 4/s"));
  VideoReader video(path("a.avi"));
  ASSERT_EQ(video.facts().frames, 4);
  EXPECT_EQ(video.facts().framesPerSecond, 4.0);
  EXPECT_EQ(video.facts().width, 40);
  // The camera moves, and frame k is the view at k / 4 s.
  EXPECT_NE(video.frame(0).data, video.frame(3).data);
  ASSERT_EQ(
      runProgram(view + "--fps 4 --seconds 0.25 --set scene.camera.time_s=0.75 --video " + path("b.avi"),
                 "-u DISPLAY")
          .code,
      0);
  VideoReader later(path("b.avi"));
  ASSERT_EQ(later.facts().frames, 1);
  EXPECT_EQ(later.frame(0).data, video.frame(3).data);
  const ProgramRun both = runProgram(
      view + "--second soft_shadows/pcf --fps 2 --seconds 0.5 --video " + path("c.avi"), "-u DISPLAY");
  ASSERT_EQ(both.code, 0) << both.text;
  EXPECT_EQ(VideoReader(path("c.avi")).facts().width, 80);
  const ProgramRun still =
      runProgram("limen-view --scene box_under_light --video " + path("d.avi"), "-u DISPLAY");
  EXPECT_EQ(still.code, 2);
  EXPECT_THAT(still.text, HasSubstr("--seconds"));
}

TEST_F(ViewProgram, ScreenshotsNeedNoDisplayAndAreTheSameEachTime) {
  for (const char* name : {"a.png", "b.png"}) {
    const ProgramRun run =
        runProgram(std::string("limen-view ") + kSmall + " --frames 2 --scale 1 --screenshot " + path(name),
                   "-u DISPLAY -u WAYLAND_DISPLAY");
    ASSERT_EQ(run.code, 0) << run.text;
  }
  const Image a = readImage(path("a.png")), b = readImage(path("b.png"));
  ASSERT_EQ(a.width, 800);
  ASSERT_EQ(a.height, 600);
  // The picture's place: times on the right differ from run to run.
  double darkest = 1.0, brightest = 0.0;
  for (int y = 60; y < 520; ++y)
    for (int x = 400; x < 460; ++x) {
      EXPECT_EQ(a.at(x, y), b.at(x, y));
      darkest = std::min(darkest, double{a.at(x, y)});
      brightest = std::max(brightest, double{a.at(x, y)});
    }
  EXPECT_GT(brightest - darkest, 0.3) << "there is no picture";
}

TEST_F(ViewProgram, BadInputIsOneLineAndOpensNothing) {
  const auto refused = [&](const std::string& arguments, const std::string& word) {
    const ProgramRun run = runProgram("limen-view " + arguments + " --screenshot " + path("x.png"));
    EXPECT_EQ(run.code, 2) << arguments << ": " << run.text;
    EXPECT_THAT(run.text, HasSubstr(word)) << arguments;
    EXPECT_EQ(std::count(run.text.begin(), run.text.end(), '\n'), 1) << run.text;
    EXPECT_FALSE(fs::exists(path("x.png")));
  };
  refused("--scene bunyn", "bunny");
  refused("--technique soft_shadows/bitmsk", "soft_shadows/bitmask");
  refused("--set technique.budgt=3", "budget");
  refused("--set technique.budget=none", "uniform");
  refused("--set technique.budget.limit=none", "whole number");
  refused("--set technique.budget.rim=3", "budget: radial");
  refused("--set colour=3", "scene.NAME=VALUE");
  refused("--size 0x9", "WIDTHxHEIGHT");
  refused("--arrangement splitt", "split");
  refused("--display crt", "display");
  refused("--scene mesh", "file");
  refused("/nowhere/x.yaml", "/nowhere/x.yaml");
}

/// The viewer in a window of a display of its own.
class ViewWindow : public ViewProgram {
 protected:
  ViewWindow() : server_(1000, 800) {
    // Made before: another thread may hold the allocator's lock while the process is copied.
    const std::string line = "unset WAYLAND_DISPLAY; DISPLAY=" + server_.display() +
                             " exec " LIMEN_BIN_DIR "/limen-view " + kSmall + " --results " +
                             path("exported") + " >" + path("out.txt") + " 2>&1";
    process_ = fork();
    if (process_ == 0) {
      execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
      _exit(127);
    }
  }
  ~ViewWindow() override {
    if (process_ > 0) {
      kill(process_, SIGKILL);
      waitpid(process_, nullptr, 0);
    }
  }

  int xdotool(const std::string& words) const {
    return std::system(("DISPLAY=" + server_.display() + " xdotool " + words + " >/dev/null 2>&1").c_str());
  }
  static bool until(const std::function<bool()>& holds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (std::chrono::steady_clock::now() < end) {
      if (holds()) return true;  // asked once: it may press keys
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }
  bool windowIsThere() const {
    return until([&] { return xdotool("search --name '^Limen$'") == 0; });
  }
  std::string exported(int number) const {
    char name[64];
    std::snprintf(name, sizeof name, "exported/exported_%03d.yaml", number);
    return path(name);
  }
  static std::string read(const std::string& file) {
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }
  /// Presses a key until the file is there: the window may not have been ready for the first.
  bool pressUntil(const std::string& key, const std::string& file) {
    return until([&] {
      if (fs::exists(file)) return true;
      xdotool("key " + key);
      std::this_thread::sleep_for(std::chrono::milliseconds(150));
      return fs::exists(file);
    });
  }
  /// Exit status, or minus the signal; waits for the end.
  int finish() {
    int status = 0;
    waitpid(process_, &status, 0);
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  test::XServer server_;
  pid_t process_ = -1;
};

TEST_F(ViewWindow, KeysAndMouseReachItAndItEndsAsTold) {
  ASSERT_TRUE(windowIsThere()) << read(path("out.txt"));
  ASSERT_TRUE(pressUntil("k", exported(1))) << read(path("out.txt"));
  EXPECT_THAT(read(exported(1)), testing::Not(HasSubstr("camera:")));
  // A drag in the middle of the picture turns the camera.
  int number = 1;
  while (fs::exists(exported(number))) ++number;
  ASSERT_TRUE(until([&] {
    // With pauses in which the window draws a frame, however slow the machine: people leave them too.
    xdotool(
        "mousemove 500 400 sleep 0.4 mousedown 1 sleep 0.4 mousemove 520 405 sleep 0.4 "
        "mousemove 590 420 sleep 0.4 mouseup 1 sleep 0.4");
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    xdotool("key k");
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    return fs::exists(exported(number)) && read(exported(number++)).find("text: \"eye ") != std::string::npos;
  })) << read(path("out.txt"));
  kill(process_, SIGTERM);
  EXPECT_EQ(finish(), 128 + SIGTERM) << read(path("out.txt"));
  EXPECT_THAT(read(path("out.txt")), HasSubstr("stopping"));
}

}  // namespace
}  // namespace limen
