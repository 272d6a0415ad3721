#include "tyndall/document/medium_file.h"

#include "tyndall/document/binding.h"
#include "tyndall/document/spelling.h"
#include "tyndall/document/whole_file.h"

namespace tyndall {
namespace {

/// What keeps a file's dials from being a medium, with a path below the file.
std::variant<Medium, Objection> compile_or_object(const MediumFile& file) {
  if (auto objection = unusable_number(file)) return *objection;
  const MediumDials si = dials_in_metres(file);
  if (auto objection = unusable_number(si)) return *objection;
  return compile(si);
}

}  // namespace

MediumFile medium_file_at(const JsonCursor& at) {
  MediumFile file;
  read_value(at, FieldFacts{}, file);
  const auto compiled = compile_or_object(file);
  if (const auto* objection = std::get_if<Objection>(&compiled)) throw at.fault_below(*objection);
  return file;
}

MediumFile medium_from_json(std::string text, const std::string& name_for_messages) {
  const JsonText json = parse_json(std::move(text), name_for_messages);
  return medium_file_at(JsonCursor(json));
}

MediumFile read_medium_file(const std::filesystem::path& file) {
  const JsonText json = read_json(file);
  return medium_file_at(JsonCursor(json));
}

Medium compile(const MediumFile& file, const std::string& name_for_messages) {
  auto compiled = compile_or_object(file);
  if (const auto* objection = std::get_if<Objection>(&compiled)) {
    throw Fault(place(name_for_messages, 0, objection->field.empty() ? "" : '/' + objection->field), objection->found,
                objection->expected);
  }
  return std::get<Medium>(std::move(compiled));
}

MediumDials dials_in_metres(const MediumFile& file) {
  return in_metres(static_cast<const MediumDials&>(file), file.meters_per_unit);
}

void move_schema(MediumFile& file, const std::filesystem::path& from, const std::filesystem::path& to) {
  namespace fs = std::filesystem;
  if (!file.schema || file.schema->empty() || file.schema->find(':') != std::string::npos) return;
  const fs::path schema(*file.schema);
  if (schema.is_absolute()) return;
  std::error_code error;
  const fs::path old_folder = fs::absolute(from, error).parent_path();
  const fs::path new_folder = fs::absolute(to, error).parent_path();
  const fs::path moved = (old_folder / schema).lexically_normal().lexically_relative(new_folder.lexically_normal());
  if (!error && !moved.empty()) file.schema = moved.generic_string();
}

std::string remark_text(const Remark& remark, const std::string& file, const std::string& pointer) {
  return printable(file) + ':' + printable(pointer + '/' + remark.field, 200) + ": found " + remark.found +
         ", expected " + remark.allowed;
}

std::string medium_to_json(const MediumFile& file) { return pretty(written(file)); }

void write_medium_file(const std::filesystem::path& file, const MediumFile& medium) {
  const std::string text = medium_to_json(medium);
  medium_from_json(text, file.string());
  write_whole_file(file, text);
}

}  // namespace tyndall
