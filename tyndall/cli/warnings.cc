#include "tyndall/cli/warnings.h"

#include <iostream>

namespace tyndall {

void warn(const MediumFile& medium, const std::string& file) {
  for (const Remark& remark : remarks_on(medium)) {
    std::cerr << "warning: " << remark_text(remark, file) << '\n';
  }
}

}  // namespace tyndall
