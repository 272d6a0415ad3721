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

/// The medium of a file without keyframes, or what keeps its dials from being one, with a path below the file.
std::variant<Medium, Objection> compile_or_object(const MediumFile& file) {
  if (auto objection = unusable_number(file)) return *objection;
  const MediumDials si = dials_in_metres(file);
  if (auto objection = unusable_number(si)) return *objection;
  return compile(si);
}

/// The file with the conditions of one of its keys.
MediumFile with_key(const MediumFile& file, std::size_t key) {
  MediumFile out = file;
  out.keyframes.reset();
  out.conditions = (*file.keyframes)[key].conditions;
  return out;
}

/// The file as it is at a time, or what keeps it from being a medium then.
std::variant<MediumFile, Objection> at_time_or_object(const MediumFile& file, double time) {
  const Keyframes& keys = *file.keyframes;
  const KeyInterval at = interval_at(keys, time);
  MediumFile out = with_key(file, at.from);
  Blend blend = dials_at(file, keys, time, file.meters_per_unit);
  if (auto* objection = std::get_if<Objection>(&blend)) return std::move(*objection);
  static_cast<MediumDials&>(out) = std::get<MediumDials>(std::move(blend));
  const auto compiled = compile_or_object(out);
  if (const auto* objection = std::get_if<Objection>(&compiled)) {
    Objection there = of_key(*objection, at.share > 0.0 ? at.to : at.from);
    if (at.share > 0.0) there.found += ", " + short_number(time) + " s, on the way to this key";
    return there;
  }
  return out;
}

/// What keeps a file from being a medium, at a key or half way to it.
std::optional<Objection> objection_to_medium(const MediumFile& file) {
  if (!file.keyframes) {
    auto compiled = compile_or_object(file);
    if (auto* objection = std::get_if<Objection>(&compiled)) return std::move(*objection);
    return std::nullopt;
  }
  if (auto objection = unusable_number(file)) return objection;
  const Keyframes& keys = *file.keyframes;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    std::vector<double> times{keys[i].time};
    if (i > 0) times.push_back(keys[i - 1].time + 0.5 * (keys[i].time - keys[i - 1].time));
    for (const double time : times) {
      auto there = at_time_or_object(file, time);
      if (auto* objection = std::get_if<Objection>(&there)) return std::move(*objection);
    }
  }
  return std::nullopt;
}

Fault fault_of(const Objection& objection, const std::string& name_for_messages) {
  return {place(name_for_messages, 0, objection.field.empty() ? "" : '/' + objection.field), objection.found,
          objection.expected};
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

/// Makes the names of grids good in the file `naming`. Where a grid does not lie below its folder the name stays, and
/// is refused when it is looked for.
void move_references(Profiles& profiles, const std::filesystem::path& naming) {
  for (Profile& profile : profiles.all) {
    auto* const grid = std::get_if<GridProfile>(&profile);
    if (grid == nullptr || grid->file.path.empty()) continue;
    std::error_code error;
    const auto folder = std::filesystem::canonical(naming.has_parent_path() ? naming.parent_path() : ".", error);
    grid->file.name = std::filesystem::path(grid->file.path).lexically_relative(folder).generic_string();
  }
}

/// Calls change(profiles) wherever profiles are among dials.
template <class T, class Change>
void for_each_profiles(T& value, const Change& change) {
  if constexpr (std::is_same_v<T, Profiles>) {
    change(value);
  } else if constexpr (OptionalMember<T>) {
    if (value) for_each_profiles(*value, change);
  } else if constexpr (ListMember<T>) {
    for (auto& element : value) for_each_profiles(element, change);
  } else if constexpr (Choice<T>) {
    std::visit([&](auto& chosen) { for_each_profiles(chosen, change); }, value);
  } else if constexpr (Described<T>) {
    for_each_field<T>([&](const auto& field) { for_each_profiles(value.*field.member, change); });
  }
}

}  // namespace

MediumFile medium_file_at(const JsonCursor& at) {
  MediumFile file;
  read_value(at, FieldFacts{}, file);
  if (const auto objection = objection_to_medium(file)) throw at.fault_below(*objection);
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

MediumFile at_time(const MediumFile& file, double time, const std::string& name_for_messages) {
  if (!file.keyframes) return file;
  auto there = at_time_or_object(file, time);
  if (const auto* objection = std::get_if<Objection>(&there)) throw fault_of(*objection, name_for_messages);
  auto& out = std::get<MediumFile>(there);
  std::erase_if(out.sources, [](const Source& source) { return source.of.rfind("/keyframes", 0) == 0; });
  return std::move(out);
}

void set_grid_time(std::vector<Profile>& profiles, double time, Grids grids) {
  for (Profile& profile : profiles) {
    if (auto* const grid = std::get_if<GridProfile>(&profile)) set_time(*grid, time, grids);
  }
}

void set_grid_time(MediumFile& file, double time, Grids grids) {
  for_each_profiles(file, [&](Profiles& profiles) { set_grid_time(profiles.all, time, grids); });
}

Medium compile(const MediumFile& file, const std::string& name_for_messages) {
  auto compiled = compile_or_object(file.keyframes ? at_time(file, 0.0, name_for_messages) : file);
  if (const auto* objection = std::get_if<Objection>(&compiled)) throw fault_of(*objection, name_for_messages);
  return std::get<Medium>(std::move(compiled));
}

std::vector<Remark> remarks_on(const MediumFile& file) {
  std::vector<Remark> out = remarks_on(dials_in_metres(file));
  for (std::size_t i = 0; file.keyframes && i < file.keyframes->size(); ++i) {
    MediumDials alone;
    alone.conditions = (*file.keyframes)[i].conditions;
    for (Remark& remark : remarks_on(in_metres(alone, file.meters_per_unit))) {
      remark.field = "keyframes/" + std::to_string(i) + '/' + remark.field;
      out.push_back(std::move(remark));
    }
  }
  return out;
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
  for_each_profiles(moved, [&](Profiles& profiles) { move_references(profiles, file); });
  const std::string text = medium_to_json(moved);
  JsonText json = parse_json(text, file.string());
  json.references = ReferenceRule{file};
  medium_file_at(JsonCursor(json));
  write_whole_file(file, text);
}

}  // namespace tyndall
