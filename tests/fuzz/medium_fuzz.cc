// Any bytes as a medium file: read or refused with a message; what is read means the same once written and read again.
#include "tests/fuzz/must.h"
#include "tyndall/document/law_text.h"
#include "tyndall/document/medium_file.h"
#include "tyndall/document/medium_summary.h"

using namespace tyndall;
using fuzz::must;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (size < 200 && is_law_text(text)) {
    try {
      must(std::isfinite(mean_cosine(law_from_text(text))), "a law has a mean cosine");
    } catch (const Fault& fault) {
      fuzz::must_be_a_message(fault);
    }
  }
  MediumFile file;
  try {
    file = medium_from_json(text, "fuzz");
  } catch (const Fault& fault) {
    fuzz::must_be_a_message(fault);
    return 0;
  }
  if (file.keyframes) {
    // At its keys it is a medium; between them, and so at time 0, numbers may still be beyond double precision.
    for (const Keyframe& key : *file.keyframes) summary_of(compile(at_time(file, key.time)));
    const MediumFile again = medium_from_json(medium_to_json(file), "again");
    must(same(file, again), "written and read again it is the same file");
    file = at_time(file, file.keyframes->front().time);
  }
  // A Fault from here on ends the process: nothing that was read may be refused later.
  const Medium medium = compile(file);
  summary_of(medium);
  const std::string written_once = medium_to_json(file);
  const MediumFile again = medium_from_json(written_once, "again");
  must(same(file, again), "written and read again it is the same file");
  must(medium_to_json(again) == written_once, "written again it is the same text");
  const Medium second = compile(again);
  must(medium.species.size() == second.species.size(), "as many species");
  for (std::size_t i = 0; i < medium.species.size(); ++i) {
    const Species &a = medium.species[i], &b = second.species[i];
    must(a.scattering == b.scattering && a.absorption == b.absorption, "the same coefficients, bit for bit");
    must(same(a.phase, b.phase) && same(a.profiles, b.profiles), "the same law and place");
    must(is_finite(a.extinction()) && smallest(a.scattering) >= 0.0 && smallest(a.absorption) >= 0.0, "admissible");
  }
  return 0;
}
