#pragma once
// The program as a user runs it, for tests.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace tyndall::tests {

/// What a run of the program left: its exit code (-1 where a signal ended it) and what it said.
struct Outcome {
  int code = -1;
  std::string out, err;
};

inline std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// A name as one word of a shell command.
inline std::string quoted(const std::filesystem::path& file) { return "'" + file.string() + "'"; }

/// A temporary folder in which the program is run.
class ProgramTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(std::filesystem::exists(TYNDALL_PROGRAM)) << "build tyndall_cli first";
    std::string name = (std::filesystem::temp_directory_path() / "tyndall-test-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Runs `tyndall <arguments>` in the folder, through the shell, whose words `before` may set limits or redirect.
  Outcome tyndall(const std::string& arguments, const std::string& before = "") const {
    const std::filesystem::path out = folder_ / "stdout", err = folder_ / "stderr";
    const std::string command = "cd " + quoted(folder_) + " && " + before + " '" + TYNDALL_PROGRAM "' " + arguments +
                                " >" + quoted(out) + " 2>" + quoted(err) + " </dev/null";
    const int status = std::system(command.c_str());
    // The shell tells a program's death by signal s as 128 + s. 130 is the program's own: stopped by Ctrl-C.
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    const Outcome run{code > 128 && code != 130 ? -1 : code, text_of(out), text_of(err)};
    std::filesystem::remove(out);
    std::filesystem::remove(err);
    return run;
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator()));
  }

  std::filesystem::path folder_;
};

}  // namespace tyndall::tests
