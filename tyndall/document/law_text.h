#pragma once
// A law in one word of a command line: henyey_greenstein:g=0.7.
#include <string>
#include <string_view>
#include <vector>

#include "tyndall/phase/law.h"

namespace tyndall {

/// Names of all laws, in the order of the list.
std::vector<std::string_view> law_names();

/// Whether a text is meant as a law: its part before the first colon is a law's name, or it is a JSON object.
bool is_law_text(std::string_view text);

/// LAW or LAW:parameter=value,parameter=value, or a law as files hold it ({"law": "mixture", ...}). Throws Fault, with
/// the nearest spelling.
Law<double> law_from_text(const std::string& text);

}  // namespace tyndall
