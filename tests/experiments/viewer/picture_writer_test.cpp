// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/picture_writer.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <stdexcept>

namespace limen::viewer {
namespace {

TEST(PictureWriter, WritesInTheBackgroundAndInOrder) {
  std::atomic<int> woken = 0;
  PictureWriter writer([&] { ++woken; });
  std::promise<void> gate;
  const std::thread::id caller = std::this_thread::get_id();
  bool elsewhere = false;
  writer.write([&, opened = gate.get_future().share()] {
    opened.wait();
    elsewhere = std::this_thread::get_id() != caller;
    return std::string("first");
  });
  writer.write([]() -> std::string { throw std::runtime_error("the disk is full"); });
  writer.write([] { return std::string("third"); });
  // Whoever asked goes on meanwhile.
  EXPECT_TRUE(writer.busy());
  EXPECT_TRUE(writer.take().empty());
  gate.set_value();
  writer.finish();
  EXPECT_FALSE(writer.busy());
  EXPECT_TRUE(elsewhere);
  const std::vector<PictureWriter::Report> reports = writer.take();
  ASSERT_EQ(reports.size(), 3U);
  EXPECT_EQ(reports[0].path, "first");
  EXPECT_EQ(reports[1].path, "");
  EXPECT_EQ(reports[1].error, "the disk is full");
  EXPECT_EQ(reports[2].path, "third");
  EXPECT_TRUE(writer.take().empty());
  EXPECT_GE(woken, 2);  // the last call may be under way
}

TEST(PictureWriter, WhatWasAskedForIsWrittenBeforeItGoes) {
  int written = 0;
  {
    PictureWriter writer([] {});
    for (int i = 0; i < 20; ++i) writer.write([&] { return std::to_string(++written); });
  }
  EXPECT_EQ(written, 20);
}

}  // namespace
}  // namespace limen::viewer
