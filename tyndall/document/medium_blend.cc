#include "tyndall/document/medium_blend.h"

#include "tyndall/document/spelling.h"

namespace tyndall {
namespace {

std::string name_between(const MediumFile& a, const MediumFile& b, double t) {
  if (a.name == b.name) return a.name;
  const std::string share = short_number(100.0 * t) + " %";
  return share + " from " + (a.name.empty() ? "one medium" : a.name) + " to " + (b.name.empty() ? "another" : b.name);
}

}  // namespace

MediumFile blended(const MediumFile& a, const MediumFile& b, double t, BlendHow how,
                   const std::string& name_for_messages) {
  if (!(t >= 0.0 && t <= 1.0)) {
    throw Fault(name_for_messages, "the share " + short_number(t), "a number from 0 to 1");
  }
  if (a.keyframes || b.keyframes) {
    return blended(at_time(a, 0.0, name_for_messages), at_time(b, 0.0, name_for_messages), t, how, name_for_messages);
  }
  if (t == 0.0) return a;
  if (t == 1.0) return b;
  MediumFile out = a;
  out.name = name_between(a, b, t);
  out.description.reset();
  out.sources.clear();  // of other numbers
  const MediumDials other = in_metres(static_cast<const MediumDials&>(b), b.meters_per_unit / a.meters_per_unit);
  Blend blend = blended(static_cast<const MediumDials&>(a), other, t, how, a.meters_per_unit);
  if (const auto* objection = std::get_if<Objection>(&blend)) {
    throw Fault(place(name_for_messages, 0, objection->field.empty() ? "" : '/' + objection->field), objection->found,
                objection->expected);
  }
  static_cast<MediumDials&>(out) = std::get<MediumDials>(blend);
  compile(out, name_for_messages);  // held visibility may be out of reach in between
  return out;
}

}  // namespace tyndall
