#include "tyndall/cli/law_list.h"

#include <algorithm>

#include "tyndall/artist/stated_species.h"
#include "tyndall/document/binding.h"
#include "tyndall/document/law_text.h"

namespace tyndall {

std::string law_list() {
  std::size_t width = 0;
  for (const std::string_view name : law_names()) width = std::max(width, name.size());
  std::string text = "Laws, as NAME or NAME:PARAMETER=VALUE,..\n";
  for_each_alternative<Law<double>>([&]<class L>(std::type_identity<L>) {
    std::string line = "  " + std::string(L::name);
    bool first = true;
    for_each_field<L>([&](const auto& field) {
      using Member = std::remove_cvref_t<decltype(std::declval<L>().*field.member)>;
      const FieldFacts facts = facts_of(field);
      line += first ? std::string(width + 4 - line.size(), ' ') : "\n" + std::string(width + 4, ' ');
      line += std::string(facts.name) + ": " + expected_value<Member>({"", facts.range, facts.unit, ""});
      if (ListMember<Member> && !facts.unit.empty()) line += " [" + std::string(facts.unit) + "]";
      first = false;
    });
    text += line + '\n';
  });
  return text + "A law with lists or parts is typed as in files: '{\"law\": \"mixture\", \"parts\": [..]}'.\n";
}

}  // namespace tyndall
