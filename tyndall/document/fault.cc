#include "tyndall/document/fault.h"

#include <utility>

#include "tyndall/document/spelling.h"

namespace tyndall {

Fault::Fault(std::string where_, std::string found_, std::string expected_)
    : where(std::move(where_)), found(std::move(found_)), expected(std::move(expected_)) {
  message_ = where + ": found " + found + ", expected " + expected;
}

std::string place(const std::string& file, std::size_t line, const std::string& pointer) {
  std::string text = file.empty() ? in_quotes(file) : printable(file);
  if (line > 0) text += ":" + std::to_string(line);
  if (!pointer.empty()) text += ": at " + printable(pointer, 200);
  return text;
}

}  // namespace tyndall
