// [glsl]
#include <cstdio>

#include "tyndall/export/law_functions.h"

int main() {
  using namespace tyndall;
  const Law<double> law = HenyeyGreenstein<double>{};  // only which law it is counts: numbers become parameters
  const auto functions = law_functions("haze", law, 1);
  const std::string text = print_functions(glsl_dialect(), functions);
  std::fputs(text.substr(0, text.find("\n\n") + 1).c_str(), stdout);
}
// [end]
