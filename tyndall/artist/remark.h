#pragma once
// What a person should know about a medium that is possible, but not in nature.
#include <string>
#include <tuple>
#include <vector>

#include "tyndall/number/described.h"

namespace tyndall {

/// A dial outside what physics allows: its path below the medium ("conditions/albedo"), what was found there, and what
/// nature has, as noun phrases. Nothing is refused for it: an Objection does that.
struct Remark {
  std::string field, found, allowed;
  bool operator==(const Remark&) const = default;
  static constexpr auto fields() {
    return std::tuple{Field{"field", &Remark::field, any_number, "", "The dial, as a path below the medium."},
                      Field{"found", &Remark::found, any_number, "", "What it is."},
                      Field{"allowed", &Remark::allowed, any_number, "", "What physics allows."}};
  }
};

/// Collects remarks under a path.
class Remarks {
 public:
  Remarks(std::vector<Remark>& out, std::string path) : out_(&out), path_(std::move(path)) {}
  /// `field` is a path below this one.
  void add(const std::string& field, std::string found, std::string allowed) const {
    out_->push_back({path_ + '/' + field, std::move(found), std::move(allowed)});
  }

 private:
  std::vector<Remark>* out_;
  std::string path_;
};

}  // namespace tyndall
