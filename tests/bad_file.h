#pragma once
// Bad files with what is to be said of them: tables of these stand in the tests of the readers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <set>
#include <span>
#include <string>

#include "tyndall/document/fault.h"

namespace tyndall::tests {

struct BadFile {
  const char* name;
  int line;                                // 0: the file as a whole
  const char *pointer, *found, *expected;  // found and expected: a part of what is said
  bool pointer_is_cut = false;             // deep and long pointers are given from their beginning only
};

/// Each file of the table in `folder` is answered with its exact line and pointer, what was found and what was
/// possible, in one printable line; and every file of the folder is in the table.
inline void check_bad_files(std::span<const BadFile> table, const std::filesystem::path& folder,
                            const std::string& extension,
                            const std::function<void(const std::filesystem::path&)>& read) {
  std::set<std::string> listed, present;
  for (const BadFile& bad : table) {
    const auto path = folder / (bad.name + extension);
    listed.insert(path.filename().string());
    SCOPED_TRACE(bad.name);
    try {
      read(path);
      ADD_FAILURE() << "accepted";
    } catch (const Fault& fault) {
      std::string where = path.string();
      if (bad.line > 0) where += ":" + std::to_string(bad.line);
      if (*bad.pointer != '\0') where += std::string(": at ") + bad.pointer;
      if (bad.pointer_is_cut) {
        EXPECT_THAT(fault.where, testing::StartsWith(where));
      } else {
        EXPECT_EQ(fault.where, where);
      }
      EXPECT_THAT(fault.found, testing::HasSubstr(bad.found));
      EXPECT_THAT(fault.expected, testing::HasSubstr(bad.expected));
      EXPECT_LT(std::string(fault.what()).size(), path.string().size() + 700);
      for (const char c : std::string(fault.what())) EXPECT_GE(static_cast<unsigned char>(c), 0x20);
    }
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    present.insert(entry.path().filename().string());
  EXPECT_EQ(listed, present);
}

}  // namespace tyndall::tests
