// SPDX-License-Identifier: MIT
#include "view/translate_request.h"

#include "bvh_options.h"
#include "style_options.h"
#include "view/page_server.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include <fmt/core.h>

#include <strut/core/error.h>
#include <strut/motion/body_parts.h>

namespace strut::cli {
namespace {

using Json = nlohmann::ordered_json;

struct NumberControl {
  std::string name, option;  ///< to which the value is appended
  const char* group;         ///< where on the page it stands
  double least, greatest;
  double& (*of)(TranslateRequest&);
};

struct SwitchControl {
  const char *name, *option;
  bool& (*of)(TranslateRequest&);
};

template <std::size_t part>
double& strength_of_part(TranslateRequest& request) {
  return request.options.controls.parts.at(part);
}

template <std::size_t... parts>
void add_parts(std::vector<NumberControl>& controls, std::index_sequence<parts...> /*all*/) {
  const auto add = [&](const char* name, double& (*of)(TranslateRequest&)) {
    controls.push_back({name, fmt::format("--part {}=", name), "parts", 0.0, kMostStrength, of});
  };
  (add(motion::kBodyPartNames.at(parts), strength_of_part<parts>), ...);
}

std::vector<NumberControl> all_numbers() {
  constexpr const char *kStyle = "style", *kFamiliarity = "generalization", *kStart = "start";
  std::vector<NumberControl> controls{
      {"strength", "--strength ", kStyle, 0.0, kMostStrength,
       [](TranslateRequest& request) -> double& { return request.options.controls.strength; }},
      {"pose", "--pose ", kStyle, 0.0, kMostStrength,
       [](TranslateRequest& request) -> double& { return request.options.controls.pose; }},
      {"movement", "--movement ", kStyle, 0.0, kMostStrength,
       [](TranslateRequest& request) -> double& { return request.options.controls.movement; }},
      {"confidence", "--confidence ", kFamiliarity, kLeastGeneralization, kMostGeneralization,
       [](TranslateRequest& request) -> double& { return request.options.generalization.confidence; }},
      {"preference", "--preference ", kFamiliarity, kLeastGeneralization, kMostGeneralization,
       [](TranslateRequest& request) -> double& { return request.options.generalization.preference; }},
      {"warmUp", "--warm-up ", kStart, 0.0, kLongestWarmUp,
       [](TranslateRequest& request) -> double& { return request.options.warm_up; }}};
  add_parts(controls, std::make_index_sequence<motion::kNumBodyParts>());
  return controls;
}

const std::vector<NumberControl>& numbers() {
  static const std::vector<NumberControl> controls = all_numbers();
  return controls;
}

const std::array<SwitchControl, 4>& switches() {
  static const std::array<SwitchControl, 4> controls{{
      {"generalization", "--no-generalization",
       [](TranslateRequest& request) -> bool& { return request.options.generalization.enabled; }},
      {"retime", "--no-retime", [](TranslateRequest& request) -> bool& { return request.options.retime; }},
      {"cleanFeet", "--no-clean-feet", [](TranslateRequest& request) -> bool& { return request.options.clean_feet; }},
      {"keepLayout", "--keep-layout", [](TranslateRequest& request) -> bool& { return request.keep_layout; }},
  }};
  return controls;
}

template <typename Controls>
const auto* find(const Controls& controls, const std::string& name) {
  const auto found =
      std::find_if(controls.begin(), controls.end(), [&](const auto& control) { return control.name == name; });
  return found == controls.end() ? nullptr : &*found;
}

void set(TranslateRequest& request, const std::string& name, const Json& value) {
  if (const NumberControl* control = find(numbers(), name)) {
    const auto number = value.get<double>();
    if (!(number >= control->least && number <= control->greatest)) {
      const std::string range = fmt::format("a number from {:g} to {:g}", control->least, control->greatest);
      throw InvalidArgument(name, range, fmt::format("{:g}", number));
    }
    control->of(request) = number;
  } else if (const SwitchControl* toggle = find(switches(), name)) {
    toggle->of(request) = value.get<bool>();
  } else {
    throw Refusal{400, "there is no control '" + name + "'", {}};
  }
}

void set_models(TranslateRequest& request, const Json& models) {
  std::vector<double> shares;
  for (const Json& model : models) {
    request.models.push_back(model.at("id"));
    if (request.models.size() > 1) shares.push_back(model.at("share").get<double>());
  }
  if (request.models.empty()) throw Refusal{400, "a style model is needed", {}};
  request.options.controls.weights = blend_weights(shares);
}

/// What a shell takes as one word.
std::string quoted(const std::string& word) {
  const bool is_plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string_view("-_./=+,:@").find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (is_plain) return word;
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// Everything that is not as usual, each option after a blank.
std::string options_of(TranslateRequest request) {
  TranslateRequest usual;
  std::string options;
  for (const NumberControl& control : numbers()) {
    const double value = control.of(request);
    if (value != control.of(usual)) options += fmt::format(" {}{}", control.option, value);
  }
  for (const SwitchControl& control : switches()) {
    if (control.of(request) != control.of(usual)) options += fmt::format(" {}", control.option);
  }
  return options;
}

std::string stem(const ViewFile& file) {
  return std::filesystem::path(file.path).stem().string();
}

}  // namespace

TranslateRequest parse_translate_request(const std::string& body) {
  const Json json = Json::parse(body);
  TranslateRequest request;
  request.clip = json.at("clip");
  set_models(request, json.at("models"));
  for (const auto& [name, value] : json.items()) {
    if (name != "clip" && name != "models") set(request, name, value);
  }
  return request;
}

Json controls_as_json() {
  TranslateRequest usual;
  Json all_numbers = Json::array(), all_switches = Json::array();
  for (const NumberControl& control : numbers()) {
    all_numbers.push_back({{"name", control.name},
                           {"group", control.group},
                           {"least", control.least},
                           {"greatest", control.greatest},
                           {"usual", control.of(usual)}});
  }
  for (const SwitchControl& control : switches()) {
    all_switches.push_back({{"name", control.name}, {"usual", control.of(usual)}});
  }
  return {{"numbers", all_numbers}, {"switches", all_switches}};
}

std::string output_name(const TranslateRequest& request, const Workspace& workspace) {
  std::string name = stem(workspace.file(request.clip, ViewKind::kClip));
  for (const std::string& model : request.models) name += "_" + stem(workspace.file(model, ViewKind::kModel));
  for (char& c : name) {
    const auto code = static_cast<unsigned char>(c);
    if (std::isalnum(code) == 0 && c != '-' && c != '.' && code < 0x80) c = '_';
  }
  return name + ".bvh";
}

std::string command_line(const TranslateRequest& request, const Workspace& workspace) {
  const auto path = [&](const std::string& model) { return workspace.file(model, ViewKind::kModel).path; };
  const std::vector<double>& weights = request.options.controls.weights;
  std::string command = "strut translate " + quoted(path(request.models.front())) + " " +
                        quoted(workspace.file(request.clip, ViewKind::kClip).path) + " -o " +
                        quoted(output_name(request, workspace));
  for (std::size_t i = 1; i < request.models.size(); ++i) {
    command += fmt::format(" --blend {}", quoted(fmt::format("{}={}", path(request.models[i]), weights[i])));
  }
  return command + options_of(request) + words_of(workspace.options().read);
}

}  // namespace strut::cli
