#include "tyndall/document/whole_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <thread>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

class WholeFile : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "tyndall-whole-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::ptrdiff_t files() const { return std::distance(fs::directory_iterator(folder_), fs::directory_iterator()); }
  fs::path folder_;
};

const std::vector<std::uint8_t> four{0, 1, 2, 255};

TEST_F(WholeFile, BytesComeFromRegularFilesOnly) {
  EXPECT_THROW(read_whole_file(folder_), Fault);
  EXPECT_THROW(read_whole_file(folder_ / "absent"), Fault);
  EXPECT_THROW(read_whole_file("/dev/null"), Fault);
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(read_whole_file(folder_ / "pipe"), Fault);
  write_whole_file(folder_ / "four", four);
  EXPECT_EQ(read_whole_file(folder_ / "four"), four);
  EXPECT_EQ(read_whole_file(folder_ / "four", 4), four);
  EXPECT_THROW(read_whole_file(folder_ / "four", 3), Fault);
  write_whole_file(folder_ / "four", "");
  EXPECT_TRUE(read_whole_file(folder_ / "four").empty());
}

TEST_F(WholeFile, TextComesFromPipesToo) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(read_whole_text(folder_ / "pipe", 10), "") << "nobody writes to it: it must not wait";
  const std::string text(1 << 20, 'x');  // more than a pipe holds
  // Open at both ends before anything is read; the writer's end closes when all is written.
  const int held = ::open((folder_ / "pipe").c_str(), O_RDWR);
  const int in = ::open((folder_ / "pipe").c_str(), O_WRONLY);
  std::thread writer([&] {
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t n = ::write(in, text.data() + done, text.size() - done);
      if (n <= 0) break;
      done += static_cast<std::size_t>(n);
    }
    ::close(in);
    ::close(held);
  });
  EXPECT_EQ(read_whole_text(folder_ / "pipe", text.size()), text);
  writer.join();
  EXPECT_THROW(read_whole_text("/dev/zero", 1000), Fault);
  EXPECT_THROW(read_whole_text(folder_, 1000), Fault);
}

TEST_F(WholeFile, WhatCannotBeWrittenIsToldBeforehand) {
  EXPECT_NO_THROW(check_writable(folder_ / "new"));
  EXPECT_EQ(files(), 0) << "asking leaves nothing";
  for (const fs::path& place : {folder_, folder_ / "", folder_ / "no" / "such", fs::path("/dev/null"), fs::path()}) {
    EXPECT_THROW(check_writable(place), Fault) << place;
    EXPECT_THROW(write_whole_file(place, "text"), Fault) << place;
  }
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_EQ(files(), 0);
}

TEST_F(WholeFile, LinksAreFollowed) {
  write_whole_file(folder_ / "real", "old");
  fs::create_symlink("real", folder_ / "link");
  fs::create_symlink("circle", folder_ / "circle");
  write_whole_file(folder_ / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(read_whole_text(folder_ / "real", 10), "new");
  EXPECT_THROW(write_whole_file(folder_ / "circle", "new"), Fault);
}

TEST_F(WholeFile, NamesMayBeAsLongAsTheSystemAllows) {
  const fs::path file = folder_ / std::string(255, 'n');
  write_whole_file(file, four);
  EXPECT_EQ(read_whole_file(file), four);
  EXPECT_THROW(check_writable(folder_ / std::string(256, 'n')), Fault);
}

TEST_F(WholeFile, AFullDiskLeavesTheOldFile) {
  write_whole_file(folder_ / "file", "old");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit tight{1000, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &tight), 0);
  EXPECT_THROW(write_whole_file(folder_ / "file", std::string(5000, 'x')), WriteFailure);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(read_whole_text(folder_ / "file", 10), "old");
  EXPECT_EQ(files(), 1) << "no temporary is left";
}

}  // namespace
}  // namespace tyndall
