#pragma once
// Where tests find the reference data that is not part of the project, and what happens where it is absent.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string_view>

namespace tyndall::tests {

/// The folder of reference data: the environment's TYNDALL_SHARED, else the folder `shared` beside the source tree.
/// It need not exist.
inline std::filesystem::path shared_folder() {
  const char* const chosen = std::getenv("TYNDALL_SHARED");
  return chosen != nullptr && *chosen != '\0' ? chosen : TYNDALL_SHARED_DIR;
}

/// True where an absent folder must fail a test rather than skip it (set by .ci/run).
inline bool shared_folder_is_required() {
  const char* const required = std::getenv("TYNDALL_REQUIRE_SHARED");
  return required != nullptr && std::string_view(required) == "1";
}

}  // namespace tyndall::tests

/// Gives `path_variable` (declared here) the path of a file or folder inside the reference data, for example
///   TYNDALL_NEEDS_SHARED_FILE(truth, "acceptance/public.json");
/// and ends the test if it is absent: skipped with a message, or failed where it is required. A macro, because
/// GTEST_SKIP must return from the test itself.
#define TYNDALL_NEEDS_SHARED_FILE(path_variable, inside)                                                     \
  const std::filesystem::path path_variable = ::tyndall::tests::shared_folder() / (inside);                  \
  if (!std::filesystem::exists(path_variable)) {                                                             \
    if (::tyndall::tests::shared_folder_is_required()) FAIL() << "reference data absent: " << path_variable; \
    GTEST_SKIP() << "reference data absent: " << path_variable;                                              \
  }                                                                                                          \
  static_assert(true, "a semicolon follows")

/// The same for the folder itself: TYNDALL_NEEDS_SHARED(shared);
#define TYNDALL_NEEDS_SHARED(path_variable) TYNDALL_NEEDS_SHARED_FILE(path_variable, "")
