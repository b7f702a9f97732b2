// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "experiments/base/error.h"
#include "study/presentation/markers.h"
#include "tests/study/presentation/pseudo_terminal.h"

namespace limen::study {
namespace {

using testing::AllOf;
using testing::HasSubstr;

int64_t nowNs() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

std::string refused(const std::string& port) {
  try {
    openMarkerPort(port);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Markers, EveryByteArrivesUnchangedAndAtItsTime) {
  test::PseudoTerminal terminal;
  const std::unique_ptr<MarkerPort> port = openMarkerPort("serial:" + terminal.device() + ":9600");
  std::vector<int64_t> before, after;
  // All values: no line discipline may swallow an end of file or turn a line feed into two bytes.
  for (int code = 1; code < 256; ++code) {
    before.push_back(nowNs());
    port->send(static_cast<uint8_t>(code));
    after.push_back(nowNs());
  }
  ASSERT_TRUE(terminal.waitFor(255));
  const auto received = terminal.received();
  ASSERT_EQ(received.size(), 255U);
  for (size_t i = 0; i < received.size(); ++i) {
    EXPECT_EQ(received[i].first, static_cast<int>(i) + 1);
    EXPECT_GE(received[i].second, before[i]);
  }
}

TEST(Markers, KnowWhenTheyWereSent) {
  test::PseudoTerminal terminal;
  Markers markers(openMarkerPort("serial:" + terminal.device()), {7, 0, 255, 20, 21});
  const int64_t before = nowNs();
  markers.send(MarkerKind::Stimulus, before - 5);
  markers.send(MarkerKind::Change, before);  // 0: not sent
  markers.send(MarkerKind::StimulusEnd, before);
  const int64_t after = nowNs();
  ASSERT_TRUE(terminal.waitFor(2));
  const std::vector<SentMarker> sent = markers.take();
  ASSERT_EQ(sent.size(), 2U);
  EXPECT_EQ(sent[0].kind, MarkerKind::Stimulus);
  EXPECT_EQ(sent[0].code, 7);
  EXPECT_EQ(sent[0].dueNs, before - 5);
  EXPECT_EQ(sent[1].code, 255);
  for (const SentMarker& marker : sent) {
    EXPECT_GE(marker.sentNs, before);
    EXPECT_LE(marker.sentNs, after);
  }
  EXPECT_TRUE(markers.take().empty());
  EXPECT_EQ(terminal.received()[0].first, 7);
  EXPECT_EQ(terminal.received()[1].first, 255);
}

TEST(Markers, APulledCableIsAFailureAndNothingIsSaidToBeSentAfterIt) {
  test::PseudoTerminal terminal;
  Markers markers(openMarkerPort("serial:" + terminal.device()), {1, 2, 3, 4, 5});
  markers.send(MarkerKind::Stimulus, 0);
  EXPECT_EQ(markers.failure(), "");
  terminal.hangUp();
  markers.send(MarkerKind::Change, 0);
  markers.send(MarkerKind::StimulusEnd, 0);
  EXPECT_THAT(markers.failure(), AllOf(HasSubstr(terminal.device()), HasSubstr("the marker was not sent")));
  EXPECT_EQ(markers.take().size(), 1U);
}

TEST(Markers, APortThatDoesNotWorkIsNamed) {
  EXPECT_THAT(refused("serial:/dev/no_such_tty"),
              AllOf(HasSubstr("/dev/no_such_tty"), HasSubstr("No such file"), HasSubstr("plugged in")));
  EXPECT_THAT(refused("parallel:/dev/no_such_parport"), HasSubstr("/dev/no_such_parport"));
  const std::string file = testing::TempDir() + "no_port";
  std::ofstream(file) << "x";
  EXPECT_THAT(refused("serial:" + file), AllOf(HasSubstr(file), HasSubstr("is not a serial port")));
  EXPECT_THAT(refused("parallel:" + file), AllOf(HasSubstr(file), HasSubstr("is not a parallel port")));
  test::PseudoTerminal terminal;
  EXPECT_THAT(refused("serial:" + terminal.device() + ":1234"),
              AllOf(HasSubstr("1234 baud"), HasSubstr("9600")));
  for (const char* form : {"", "serial", "serial:", "usb:/dev/ttyUSB0", "serial:/dev/ttyUSB0:fast"})
    EXPECT_THAT(refused(form), HasSubstr("serial:/dev/ttyUSB0")) << form;
}

}  // namespace
}  // namespace limen::study
