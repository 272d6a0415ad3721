#include "tyndall/document/rehearsal.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "tyndall/document/fault.h"

namespace tyndall {
namespace {

std::string fault_of(const std::function<void()>& act, const RehearsalLimits& limits = {}) {
  try {
    rehearse("the place", "something sound", act, limits);
  } catch (const Fault& fault) {
    return fault.where + "|" + fault.found + "|" + fault.expected;
  }
  return "";
}

TEST(Rehearsal, WhatEndsWellIsHeardOfNoMore) {
  int seen = 0;
  EXPECT_EQ(fault_of([&seen] { seen = 1; }), "");
  EXPECT_EQ(seen, 0) << "it ran in this process";
}

TEST(Rehearsal, FaultsComeBackWhole) {
  const std::string text = fault_of([] { throw Fault("file:3", "the number 5", "less"); });
  EXPECT_EQ(text, "file:3|the number 5|less");
  const std::string long_text(200000, 'x');
  EXPECT_EQ(fault_of([&] { throw Fault(long_text, "", long_text); }), long_text + "||" + long_text);
}

TEST(Rehearsal, CrashesAreFaults) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGILL, SIGFPE, SIGKILL}) {
    const std::string text = fault_of([signal] {
      std::signal(signal, SIG_DFL);  // a sanitizer's own handler would talk about it
      std::raise(signal);
    });
    EXPECT_NE(text.find("crashes its reader"), std::string::npos) << signal << ": " << text;
    EXPECT_NE(text.find("the place|"), std::string::npos);
    EXPECT_NE(text.find("|something sound"), std::string::npos);
  }
  EXPECT_NE(fault_of([] { ::_exit(3); }).find("exit code 3"), std::string::npos);
  EXPECT_NE(fault_of([] { ::_exit(0); }).find("broke off"), std::string::npos);
  EXPECT_NE(fault_of([] { throw std::runtime_error("secret"); }).find("broke off"), std::string::npos);
}

TEST(Rehearsal, EndlessWorkEnds) {
  const std::string text = fault_of(
      [] {
        volatile unsigned x = 0;
        for (;;) x = x + 1;
      },
      {std::uint64_t{1} << 30, 1});
  EXPECT_NE(text.find("busy for more than 1 s"), std::string::npos) << text;
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // these leave no room for a memory limit
TEST(Rehearsal, AppetiteForMemoryIsAFault) {
  const auto eat = [] {
    std::vector<std::vector<char>> eaten;
    for (;;) eaten.emplace_back(std::size_t{64} << 20, 'x');
  };
  EXPECT_NE(fault_of(eat, {std::uint64_t{256} << 20, 30}).find("too much memory"), std::string::npos);
}
#endif

}  // namespace
}  // namespace tyndall
