#include "tyndall/document/named_medium.h"

#include "tyndall/document/law_text.h"
#include "tyndall/document/preset.h"
#include "tyndall/document/reference.h"
#include "tyndall/document/spelling.h"

namespace tyndall {
namespace {

NamedMedium read_preset(const Preset& preset) {
  return {medium_from_json(std::string(preset.text), title_of(preset)), title_of(preset)};
}

bool is_there(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::exists(path, error);
}

Fault neither(const std::string& where, const std::string& text) {
  if (is_law_text(text)) {
    return {where, in_quotes(text) + ", a law of scattering",
            "a medium file or a preset (tyndall presets lists them); tyndall phase and plot take laws"};
  }
  return {where, in_quotes(text) + ", neither a preset nor a file",
          "a medium file, or " + one_of(text, preset_names())};
}

}  // namespace

bool is_bare_word(std::string_view text) { return !text.empty() && text.find_first_of("/.") == text.npos; }

NamedMedium read_named_medium(const std::string& text, bool allow_path) {
  if (const Preset* preset = preset_named(text)) return read_preset(*preset);
  if (text.empty()) throw Fault("medium", "an empty name", "a medium file or a preset (tyndall presets lists them)");
  if ((is_bare_word(text) || is_law_text(text)) && !is_there(text)) throw neither("medium", text);
  return {read_medium_file(text, allow_path), text};
}

NamedMedium read_named_medium(const std::filesystem::path& naming, const std::string& text, bool allow_path,
                              const std::string& where) {
  if (const Preset* preset = preset_named(text)) return read_preset(*preset);
  if (is_bare_word(text) && !is_there(naming.parent_path() / text)) throw neither(where, text);
  const std::filesystem::path path = referenced_file(naming, text, allow_path, where);
  return {read_medium_file(path, allow_path), path.string()};
}

NamedMedium read_named_medium_beside_laws(const std::string& where, const std::string& text, bool allow_path) {
  const std::string word = text.substr(0, text.find(':'));
  if (preset_named(text) == nullptr && is_bare_word(word) && !is_there(text)) {
    const std::vector<std::string_view> laws = law_names(), media = preset_names();
    const bool law = !nearest_spelling(word, laws).empty() || nearest_spelling(word, media).empty();
    throw Fault(where, in_quotes(text) + ", neither a law, a preset nor a file",
                law ? "a medium file, a preset (tyndall presets lists them) or " + one_of(word, laws)
                    : "a medium file, a law or " + one_of(word, media));
  }
  return read_named_medium(text, allow_path);
}

}  // namespace tyndall
