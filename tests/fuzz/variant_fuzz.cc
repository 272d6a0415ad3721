// Any bytes, to the first zero, as a medium, and the rest as a variant of it: read or refused with a message; what is
// read means the same once it is written without its base.
#include "tests/fuzz/folder.h"
#include "tyndall/document/medium_file.h"

using namespace tyndall;
using fuzz::must;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::size_t zero = bytes.find('\0');
  if (zero == bytes.npos) return 0;
  folder.write("base.medium.json", bytes.substr(0, zero));
  const auto variant = folder.write("variant.medium.json", bytes.substr(zero + 1));
  MediumFile file;
  try {
    file = read_medium_file(variant);
  } catch (const Fault& fault) {
    fuzz::must_be_a_message(fault);
    return 0;
  }
  compile(file);
  const std::string alone = medium_to_json(file);
  must(same(file, medium_from_json(alone, "alone")), "it is the same without its base");
  return 0;
}
