#include "tyndall/document/medium_file.h"

#include "tyndall/document/base_medium.h"
#include "tyndall/document/binding.h"
#include "tyndall/document/file_kind.h"
#include "tyndall/document/number_rows.h"
#include "tyndall/document/reference.h"
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

/// The name by which `naming` could refer to a file of numbers; none where it cannot, or where the file has changed.
std::optional<std::string> name_from(const std::filesystem::path& naming, const NumberFile& file) {
  std::error_code error;
  const auto folder = std::filesystem::canonical(naming.has_parent_path() ? naming.parent_path() : ".", error);
  const std::string name = std::filesystem::path(file.path).lexically_relative(folder).generic_string();
  try {
    const NumberRows now = read_number_rows(referenced_file(naming, name, false, ""));
    if (NumberFile{name, "", std::make_shared<const NumberRows>(now)} == file) return name;
  } catch (const Fault&) {
  }
  return std::nullopt;
}

/// Makes a law's references good in the file `naming`, or its numbers its own.
void move_references(Law<double>& law, const std::filesystem::path& naming) {
  if (auto* mixture = std::get_if<Mixture<double>>(&law)) {
    for (auto& part : mixture->parts) move_references(part.phase, naming);
  }
  auto* const table = std::get_if<Tabulated<double>>(&law);
  if (table == nullptr || !table->from_file()) return;
  if (const auto name = name_from(naming, *table->file)) {
    table->file->name = *name;
  } else {
    *table = table->written_out();
  }
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
  JsonText json = parse_json(std::move(text), name_for_messages);
  resolve_base(json);
  return medium_file_at(JsonCursor(json));
}

MediumFile read_medium_file(const std::filesystem::path& file, bool allow_path) {
  refuse_other_kinds(file, FileKind::medium);
  JsonText json = read_json(file, allow_path);
  refuse_other_kinds(json, FileKind::medium);
  resolve_base(json);
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
  MediumFile moved = medium;
  for (StatedSpecies& species : moved.species) move_references(species.phase, file);
  const std::string text = medium_to_json(moved);
  JsonText json = parse_json(text, file.string());
  json.references = ReferenceRule{file};
  medium_file_at(JsonCursor(json));
  write_whole_file(file, text);
}

}  // namespace tyndall
