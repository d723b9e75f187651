// SPDX-License-Identifier: MIT
#include "effort/label_checks.h"

#include <charconv>
#include <regex>
#include <string>

#include <strut/core/error.h>

namespace strut::effort {
namespace {

int number_at(std::string_view text, std::size_t place) {
  int number = 0;
  std::from_chars(text.data() + place, text.data() + place + 2, number);
  return number;
}

int days_in(int year, int month) {
  if (month == 2) return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0) ? 29 : 28;
  return month == 4 || month == 6 || month == 9 || month == 11 ? 30 : 31;
}

void check_line(const std::string& field, const std::string& text) {
  const auto breaks = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  for (const char c : text) {
    if (breaks(static_cast<unsigned char>(c))) throw InvalidArgument(field, "one line of text", "a line break in it");
  }
}

void check_factor(const LabelRecord& label, std::size_t factor) {
  const double value = label.rating[static_cast<Eigen::Index>(factor)];
  if (is_rated(value) && !(value >= -1.0 && value <= 1.0)) {
    throw InvalidArgument(kFactorNames[factor], "a number from -1 to 1", std::to_string(value));
  }
  if (is_rated(value) && label.not_present[factor]) {
    throw InvalidArgument(kFactorNames[factor], "no rating of a factor that is not present", std::to_string(value));
  }
}

}  // namespace

bool is_iso_time(std::string_view text) noexcept {
  static const std::regex kForm(R"(\d{4}-\d\d-\d\d[T ]\d\d:\d\d(:\d\d(\.\d+)?)?(Z|[+-]\d\d:?\d\d)?)");
  if (!std::regex_match(text.begin(), text.end(), kForm)) return false;
  const int year = 100 * number_at(text, 0) + number_at(text, 2), month = number_at(text, 5), day = number_at(text, 8);
  const bool has_seconds = text.size() > 18 && text[16] == ':';
  return month >= 1 && month <= 12 && day >= 1 && day <= days_in(year, month) && number_at(text, 11) < 24 &&
         number_at(text, 14) < 60 && (!has_seconds || number_at(text, 17) <= 60);
}

void check_label(const LabelRecord& label) {
  if (label.rater.empty()) throw InvalidArgument("rater", "who labelled it", "nothing");
  check_line("rater", label.rater);
  check_line("comment", label.comment);
  if (!is_iso_time(label.labelled_at)) {
    throw InvalidArgument("labelled_at", "a time as 2026-03-01T14:05:00Z", "'" + label.labelled_at + "'");
  }
  bool says_something = false;
  for (std::size_t k = 0; k < kNumFactors; ++k) {
    check_factor(label, k);
    says_something |= label.not_present[k] || is_rated(label.rating[static_cast<Eigen::Index>(k)]);
  }
  if (!says_something) throw InvalidArgument("rating", "at least one factor", "none");
}

}  // namespace strut::effort
