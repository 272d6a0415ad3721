#pragma once
// The reference data by category and case, so that nothing in it is passed over: a key that nobody reads is a failure.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "tests/shared_folder.h"

namespace tyndall::tests {

/// One case. Reading a key is noted.
class AcceptanceCase {
 public:
  AcceptanceCase(const nlohmann::json& item, std::string name) : item_(item), name_(std::move(name)) {}

  /// What the case is, for messages.
  const std::string& name() const { return name_; }
  bool has(const std::string& key) const { return item_.contains(key); }
  const nlohmann::json& operator[](const std::string& key) {
    read_.insert(key);
    return item_.at(key);
  }
  double number(const std::string& key) { return value((*this)[key]); }
  std::string text(const std::string& key) { return (*this)[key].get<std::string>(); }
  /// A number, or the text of one.
  static double value(const nlohmann::json& x) {
    return x.is_string() ? std::stod(x.get<std::string>()) : x.get<double>();
  }
  /// Keys that no test can read yet, and what must be there first.
  void leave(const std::set<std::string>& keys, const char* until) {
    for (const std::string& key : keys) {
      if (item_.contains(key) && read_.insert(key).second) ::testing::Test::RecordProperty("left until", until);
    }
  }
  void expect_read_to_the_end() const {
    for (const auto& member : item_.items())
      EXPECT_TRUE(read_.count(member.key()) > 0) << name_ << ": nothing tests the key " << member.key();
  }

 private:
  const nlohmann::json& item_;
  std::string name_;
  std::set<std::string> read_;
};

/// visit(category's name, its content) for each category of each file of the folder.
template <class Visit>
void for_each_category(const std::filesystem::path& folder, Visit visit) {
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() != ".json") continue;
    std::ifstream in(file.path());
    const nlohmann::json all = nlohmann::json::parse(in);
    for (const auto& member : all.items()) visit(member.key(), member.value());
  }
}

/// check(case) for each case of a category; fails if there are fewer than `least`, or something in one is not read.
template <class Check>
void for_each_case(const std::filesystem::path& folder, const std::string& category, int least, Check check) {
  int count = 0;
  for_each_category(folder, [&](const std::string& name, const nlohmann::json& content) {
    if (name != category) return;
    for (const nlohmann::json& item : content.at("items")) {
      AcceptanceCase one(item, category + " " + std::to_string(count++));
      SCOPED_TRACE(one.name());
      check(one);
      one.expect_read_to_the_end();
    }
  });
  EXPECT_GE(count, least) << category;
  ::testing::Test::RecordProperty("cases_of_" + category, count);
}

}  // namespace tyndall::tests
