// SPDX-License-Identifier: MIT
#include "sysid_report.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <fmt/core.h>

#include <strut/sysid/initial_state.h>

namespace strut::cli {
namespace {

using Json = nlohmann::ordered_json;
using sysid::Experiment;

/// Poles with the largest modulus first, of a pair the one above the real axis.
std::vector<std::complex<double>> upper_poles(const sysid::LtiSystem& system) {
  std::vector<std::complex<double>> found;
  for (const std::complex<double>& pole : system.poles()) {
    if (pole.imag() >= 0.0) found.push_back(pole);
  }
  std::sort(found.begin(), found.end(), [](const auto& x, const auto& y) { return std::abs(x) > std::abs(y); });
  return found;
}

// ---- for a person ---------------------------------------------------------------------------------------------------

int num_frames(const std::vector<Experiment>& clips) {
  int frames = 0;
  for (const Experiment& clip : clips) frames += clip.num_frames();
  return frames;
}

std::string counted(const std::vector<Experiment>& clips) {
  return fmt::format("{} rows in {} clip{}", num_frames(clips), clips.size(), clips.size() == 1 ? "" : "s");
}

void print_orders(const sysid::Identified& found) {
  fmt::print("\norder  singular value  left-out fit{}\n", found.refined_fit.empty() ? "" : "  refined");
  for (std::size_t k = 0; k < found.left_out_fit.size(); ++k) {
    const bool has_value = k > 0 && static_cast<Eigen::Index>(k) <= found.singular_values.size();
    fmt::print("{:>5}  {:>14}  {:>10.1f} %", k,
               has_value ? fmt::format("{:.4g}", found.singular_values[static_cast<Eigen::Index>(k) - 1]) : "",
               found.left_out_fit[k]);
    if (!found.refined_fit.empty()) fmt::print("  {:>5.1f} %", found.refined_fit[k]);
    const bool is_chosen = static_cast<int>(k) == found.system.num_states();
    fmt::print("{}\n", !is_chosen ? "" : found.is_refined ? "  <- chosen, refined" : "  <- chosen");
  }
}

const char* name_of(sysid::Estimate estimate) {
  switch (estimate) {
    case sysid::Estimate::kSubspace:
      return "subspace";
    case sysid::Estimate::kFilteredSubspace:
      return "subspace, filtered";
    case sysid::Estimate::kRegularized:
      return "regularized";
    case sysid::Estimate::kFilteredRegularized:
      return "regularized, filtered";
    case sysid::Estimate::kStatic:
      return "static map";
  }
  return "";
}

bool is_taken(const sysid::Combined& found, sysid::Estimate estimate) {
  return std::find(found.estimates.begin(), found.estimates.end(), estimate) != found.estimates.end();
}

void print_estimates(const sysid::Combined& found) {
  fmt::print("\n{:<22} left-out fit\n", "estimate");
  for (std::size_t k = 0; k < found.fit_alone.size(); ++k) {
    const auto estimate = static_cast<sysid::Estimate>(k);
    fmt::print("{:<22} {:>10.1f} %{}\n", name_of(estimate), found.fit_alone[k],
               is_taken(found, estimate) ? "  <- taken" : "");
  }
  fmt::print("{:<22} {:>10.1f} %  {} states\n", "mean of those taken", found.fit, found.system.num_states());
}

void print_poles(const sysid::LtiSystem& system) {
  fmt::print("\npoles{}\n", system.num_states() == 0 ? ": none, a static map" : "");
  for (const std::complex<double>& pole : upper_poles(system)) {
    const double radius = std::abs(pole);
    const double decay = radius > 0.0 ? -1.0 / std::log(radius) : 0.0;
    fmt::print("  {:.4f}", pole.real());
    if (pole.imag() > 0.0) fmt::print(" +- {:.4f}i", pole.imag());
    fmt::print("  modulus {:.4f}, decays to 1/e in {:.1f} frames", radius, decay);
    if (pole.imag() > 0.0) fmt::print(", period {:.1f} frames", 2.0 * std::numbers::pi / std::arg(pole));
    fmt::print("\n");
  }
}

void print_fit_row(const char* what, const Eigen::VectorXd& fits, double mean) {
  fmt::print("{:<36}", what);
  for (const double fit : fits) fmt::print(" {:>10.1f}", fit);
  fmt::print(" {:>10.1f}\n", mean);
}

void print_fits(const SysidFindings& findings) {
  fmt::print("\n{:<36}", "fit [%]");
  for (const std::string& name : findings.outputs) fmt::print(" {:>10}", name);
  fmt::print(" {:>10}\n", "mean");
  const auto print_set = [](const char* set, const SysidFits& fits) {
    print_fit_row(fmt::format("{}, simulated from rest", set).c_str(), fits.simulated, fits.mean_simulated);
    print_fit_row(fmt::format("{}, initial state fitted", set).c_str(), fits.fitted, fits.mean_fitted);
    print_fit_row(fmt::format("{}, predicted one row ahead", set).c_str(), fits.predicted, fits.mean_predicted);
  };
  print_set("training", findings.train_fits);
  if (!findings.test.empty()) print_set("test", findings.test_fits);
}

void print_residuals(const SysidFindings& findings) {
  const sysid::ResidualTests& tests = findings.prediction;
  fmt::print("\nresiduals of prediction, {} lags: {} of {} autocorrelations beyond +-{:.3f} (1 in 100 expected)\n",
             tests.num_lags(), tests.num_beyond(), tests.autocorrelation.size(), tests.autocorrelation_bound);
  for (std::size_t o = 0; o < findings.outputs.size(); ++o) {
    const auto k = static_cast<Eigen::Index>(o);
    fmt::print("  {}: Ljung-Box {:.1f}, probability if white {:.3g}\n", findings.outputs[o], tests.ljung_box[k],
               tests.whiteness[k]);
  }
  const sysid::ResidualTests& left = findings.simulation;
  fmt::print("residuals of simulation against inputs, the largest correlation (bound):\n");
  for (std::size_t o = 0; o < findings.outputs.size(); ++o) {
    fmt::print("  {}:", findings.outputs[o]);
    for (std::size_t i = 0; i < findings.inputs.size(); ++i) {
      const auto [row, col] = std::pair(static_cast<Eigen::Index>(o), static_cast<Eigen::Index>(i));
      fmt::print("{} {} {:.3f} ({:.3f})", i == 0 ? "" : ",", findings.inputs[i], left.cross_correlation(row, col),
                 left.cross_bound(row, col));
    }
    fmt::print("\n");
  }
}

// ---- for a program --------------------------------------------------------------------------------------------------

Json json_vector(const Eigen::Ref<const Eigen::VectorXd>& vector) {
  Json out = Json::array();
  for (const double number : vector) out.push_back(number);
  return out;
}

Json json_matrix(const Eigen::MatrixXd& matrix) {
  Json out = Json::array();
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) out.push_back(json_vector(matrix.row(row).transpose()));
  return out;
}

Json json_fits(const SysidFits& fits) {
  return {{"simulated_from_rest", {{"mean", fits.mean_simulated}, {"outputs", json_vector(fits.simulated)}}},
          {"initial_state_fitted", {{"mean", fits.mean_fitted}, {"outputs", json_vector(fits.fitted)}}},
          {"predicted", {{"mean", fits.mean_predicted}, {"outputs", json_vector(fits.predicted)}}}};
}

Json json_residuals(const sysid::ResidualTests& tests) {
  return {{"lags", tests.num_lags()},
          {"autocorrelation", json_matrix(tests.autocorrelation)},
          {"autocorrelation_bound", tests.autocorrelation_bound},
          {"beyond_bound", tests.num_beyond()},
          {"ljung_box", json_vector(tests.ljung_box)},
          {"probability_if_white", json_vector(tests.whiteness)},
          {"input_correlation", json_matrix(tests.cross_correlation)},
          {"input_correlation_bound", json_matrix(tests.cross_bound)}};
}

Json json_estimates(const sysid::Combined& found) {
  Json out = Json::array();
  for (std::size_t k = 0; k < found.fit_alone.size(); ++k) {
    const auto estimate = static_cast<sysid::Estimate>(k);
    out.push_back(
        {{"name", name_of(estimate)}, {"left_out_fit", found.fit_alone[k]}, {"taken", is_taken(found, estimate)}});
  }
  return out;
}

Json json_poles(const sysid::LtiSystem& system) {
  Json out = Json::array();
  for (const std::complex<double>& pole : upper_poles(system)) {
    out.push_back({pole.real(), pole.imag()});
    if (pole.imag() > 0.0) out.push_back({pole.real(), -pole.imag()});
  }
  return out;
}

}  // namespace

SysidFits fits_on(const std::vector<Experiment>& clips, const sysid::LtiSystem& system, const Eigen::MatrixXd& gain) {
  sysid::FitSum simulated(system.num_outputs()), fitted(system.num_outputs()), predicted(system.num_outputs());
  for (const Experiment& clip : clips) {
    simulated.add(clip, simulate(system, clip.input));
    fitted.add(clip, simulate(system, clip.input, estimate_initial_state(system, clip)));
    predicted.add(clip, predict(system, gain, clip));
  }
  return {simulated.fit_per_output(),
          fitted.fit_per_output(),
          predicted.fit_per_output(),
          simulated.fit(),
          fitted.fit(),
          predicted.fit()};
}

void print_report(const SysidFindings& findings) {
  fmt::print("{}: {} input{}, {} output{}\n", findings.path, findings.inputs.size(),
             findings.inputs.size() == 1 ? "" : "s", findings.outputs.size(), findings.outputs.size() == 1 ? "" : "s");
  fmt::print("trained on {}", counted(findings.train));
  if (!findings.test.empty()) fmt::print(", tested on {}", counted(findings.test));
  fmt::print("\n");
  print_orders(findings.found.subspace);
  if (findings.found.fit_alone.size() > 1) print_estimates(findings.found);
  print_poles(findings.found.system);
  print_fits(findings);
  print_residuals(findings);
}

Json report_as_json(const SysidFindings& findings) {
  const sysid::LtiSystem& system = findings.found.system;
  Json json{{"kind", "strut linear system"}, {"version", 1}};
  json["equations"] =
      "x[t+1] = A x[t] + B (u[t] - input_mean) + K e[t], y[t] - output_mean = C x[t] + D (u[t] - "
      "input_mean) + e[t]";
  json["inputs"] = findings.inputs;
  json["outputs"] = findings.outputs;
  json["input_mean"] = json_vector(findings.input_mean.transpose());
  json["output_mean"] = json_vector(findings.output_mean.transpose());
  json["order"] = system.num_states();
  json["A"] = json_matrix(system.a());
  json["B"] = json_matrix(system.b());
  json["C"] = json_matrix(system.c());
  json["D"] = json_matrix(system.d());
  json["K"] = json_matrix(findings.noise.gain);
  json["noise"] = {{"is_filter", findings.noise.is_filter},
                   {"state", json_matrix(findings.noise.covariances.state)},
                   {"state_output", json_matrix(findings.noise.covariances.cross)},
                   {"output", json_matrix(findings.noise.covariances.output)},
                   {"innovation", json_matrix(findings.noise.innovation)}};
  json["initial_states"] = Json::array();
  for (const Eigen::VectorXd& state : findings.initial_states) json["initial_states"].push_back(json_vector(state));
  json["poles"] = json_poles(system);
  json["refined"] = findings.found.subspace.is_refined;
  json["left_out_fit"] = findings.found.subspace.left_out_fit;
  json["refined_left_out_fit"] = findings.found.subspace.refined_fit;
  json["estimates"] = json_estimates(findings.found);
  json["singular_values"] = json_vector(findings.found.subspace.singular_values);
  json["fit"]["training"] = json_fits(findings.train_fits);
  if (!findings.test.empty()) json["fit"]["test"] = json_fits(findings.test_fits);
  json["residuals"] = {{"prediction", json_residuals(findings.prediction)},
                       {"simulation", json_residuals(findings.simulation)}};
  return json;
}

}  // namespace strut::cli
