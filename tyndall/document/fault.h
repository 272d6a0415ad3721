#pragma once
// What is thrown from floor 5 up when something given from outside (a file, an argument) cannot be used.
#include <cstddef>
#include <exception>
#include <string>

namespace tyndall {

/// Bad input: where it is, what was found there, and what was possible. Programs print what() and exit with 2; nothing
/// has been written when it is thrown.
class Fault : public std::exception {
 public:
  /// `where` is a place() or another name of the thing at fault; `found` and `expected` are noun phrases, for example
  /// "the number 1.5" and "a number from 0 to 1". Text from outside goes in through in_quotes() (spelling.h).
  Fault(std::string where, std::string found, std::string expected);

  /// "where: found ..., expected ...".
  const char* what() const noexcept override { return message_.c_str(); }

  std::string where, found, expected;

 private:
  std::string message_;
};

/// A Fault about a value whose parts are well formed one by one (types, ranges, keys, words) but do not go together:
/// what objection_to() objects to. A JSON Schema refuses every other kind, this one only where demands_of() says how.
class DemandFault : public Fault {
 public:
  using Fault::Fault;
};

/// "file:line: at /pointer"; line 0 and an empty pointer (the whole file) are left out.
std::string place(const std::string& file, std::size_t line = 0, const std::string& pointer = "");

}  // namespace tyndall
