// SPDX-License-Identifier: MIT
#include "support/xml.h"

#include <regex>
#include <set>
#include <string>
#include <vector>

namespace strut::test {
namespace {

/// Characters and references of text or of an attribute's value.
std::string text_error(const std::string& text) {
  static const std::regex kReference("&(amp|lt|gt|quot|apos|#[0-9]+);");
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte < 0x20 && byte != '\n' && byte != '\t') return "a control character in '" + text.substr(0, 40) + "'";
    if (text[i] == '<') return "a bare < in '" + text.substr(0, 40) + "'";
    if (text[i] == '&' && !std::regex_search(text.begin() + static_cast<std::ptrdiff_t>(i), text.end(), kReference,
                                             std::regex_constants::match_continuous)) {
      return "a bare & in '" + text.substr(0, 40) + "'";
    }
  }
  return {};
}

/// The ids an element gives and refers to.
struct Ids {
  std::set<std::string> given, used;
};

std::string attributes_error(const std::string& attributes, Ids& ids) {
  static const std::regex kAttribute("\\s+([A-Za-z_:][-\\w:.]*)=\"([^\"]*)\""), kUse("url\\(#([^)]*)\\)");
  std::set<std::string> names;
  std::size_t place = 0;
  for (std::sregex_iterator found(attributes.begin(), attributes.end(), kAttribute), end; found != end; ++found) {
    if (static_cast<std::size_t>(found->position()) != place) break;
    place += static_cast<std::size_t>(found->length());
    if (!names.insert((*found)[1]).second) return "attribute " + (*found)[1].str() + " twice";
    const std::string value = (*found)[2];
    if (std::string error = text_error(value); !error.empty()) return error;
    if ((*found)[1] == "id" && !ids.given.insert(value).second) return "id " + value + " twice";
    std::smatch use;
    if (std::regex_match(value, use, kUse)) ids.used.insert(use[1]);
  }
  if (attributes.find_first_not_of(" \n", place) == std::string::npos) return {};
  return "not attributes: '" + attributes.substr(place, 40) + "'";
}

}  // namespace

std::string xml_error(const std::string& text) {
  std::vector<std::string> open;
  Ids ids;
  bool is_over = false;
  std::size_t place = 0;
  while (place < text.size()) {
    const std::size_t begin = text.find('<', place);
    const std::string between = text.substr(place, begin == std::string::npos ? begin : begin - place);
    if (std::string error = text_error(between); !error.empty()) return error;
    if (open.empty() && between.find_first_not_of(" \n") != std::string::npos) return "text outside: " + between;
    if (begin == std::string::npos) break;
    if (is_over) return "more than one element";
    const std::size_t end = text.find('>', begin);
    if (end == std::string::npos) return "a tag without end";
    std::string tag = text.substr(begin + 1, end - begin - 1);
    const bool closes = tag.starts_with('/'), is_empty = tag.ends_with('/');
    if (closes) tag.erase(0, 1);
    if (is_empty) tag.pop_back();
    const std::string name = tag.substr(0, tag.find_first_of(" \n"));
    if (closes) {
      if (open.empty() || open.back() != name) return "</" + name + "> closes nothing";
      open.pop_back();
    } else {
      if (std::string error = attributes_error(tag.substr(name.size()), ids); !error.empty()) return error;
      if (!is_empty) open.push_back(name);
    }
    is_over = open.empty();
    place = end + 1;
  }
  if (!open.empty()) return "<" + open.back() + "> is not closed";
  if (!is_over) return "no element";
  for (const std::string& id : ids.used) {
    if (ids.given.count(id) == 0) return "there is no #" + id;
  }
  return {};
}

}  // namespace strut::test
