#pragma once
// What a command says on stderr of media that are possible, but not in nature.
#include <string>

#include "tyndall/document/medium_file.h"

namespace tyndall {

/// A line "warning: file:/pointer: ..." for each remark on the medium.
void warn(const MediumFile& medium, const std::string& file);

}  // namespace tyndall
