// SPDX-License-Identifier: MIT
// Identification beside a reference on public sets: prints docs/sysid.md's tables.
//   sysid_study FOLDER [max_order=N] [block_rows=N] [max_radius=R] [tolerance=T] [weighting=cva|moesp|n4sid] [refine=N]
//               [starts=lead_in] [max_states=N]
// FOLDER holds *.dat (columns: inputs, then outputs) with index.csv and slicot_reference.csv, and mocap/*.txt (columns:
// clip, 1 = training, inputs, as many outputs) with slicot_reference_mocap.csv. The first half of a .dat trains, the
// second half tests, all scaled by the training rows' mean and deviation. Everything is simulated from x0 = 0. Options
// are identify_combined's defaults, but for the .dat, whose poles are slower than motion's: max_order 8, max_radius
// 0.999. In brackets the number of states.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <strut/core/error.h>
#include <strut/sysid/combine.h>

namespace {

using strut::FrameMatrix;
using strut::sysid::CombineOptions;
using strut::sysid::Experiment;
using strut::sysid::IdentifyOptions;
using strut::sysid::Weighting;

struct Task {
  std::string name;
  std::vector<Experiment> train, test;
};

/// The reference's test fits on one set [%].
struct Reference {
  double static_map = -1e300;  ///< without states
  double automatic = -1e300;   ///< the best of its automatic orders, over block rows and rules: chosen by the test data
  double best = -1e300;        ///< the best of all its runs and orders: likewise
};

FrameMatrix read_table(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<double> numbers;
  Eigen::Index rows = 0;
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    for (double number; fields >> number;) numbers.push_back(number);
    ++rows;
  }
  if (rows == 0) throw std::runtime_error("nothing in " + path.string());
  return Eigen::Map<FrameMatrix>(numbers.data(), rows, static_cast<Eigen::Index>(numbers.size()) / rows);
}

std::vector<std::map<std::string, std::string>> read_csv(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  std::vector<std::string> names;
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::vector<std::string> values;
    for (std::string value; std::getline(fields, value, ',');) values.push_back(value);
    if (names.empty()) {
      names = values;
      continue;
    }
    rows.emplace_back();
    for (std::size_t k = 0; k < std::min(names.size(), values.size()); ++k) rows.back()[names[k]] = values[k];
  }
  return rows;
}

std::map<std::string, Reference> read_reference(const std::filesystem::path& path, const std::string& key) {
  std::map<std::string, Reference> references;
  for (auto& row : read_csv(path)) {
    if (row["fit_test"].empty()) continue;
    Reference& reference = references[row[key]];
    const double fit = std::atof(row["fit_test"].c_str());
    if (row["method"] == "static_ls") {
      reference.static_map = fit;
      continue;
    }
    const bool is_automatic = row["n_req"] == "-1" || row["n_req"] == "auto";
    if (is_automatic) reference.automatic = std::max(reference.automatic, fit);
    reference.best = std::max(reference.best, fit);
  }
  return references;
}

/// Takes off the mean and divides by the deviation of the rows for which `trains` is true.
void standardize(FrameMatrix& table, const Eigen::Array<bool, Eigen::Dynamic, 1>& trains) {
  const Eigen::VectorXd weight = trains.cast<double>();
  const double rows = weight.sum();
  const Eigen::RowVectorXd mean = (weight.transpose() * table) / rows;
  table.rowwise() -= mean;
  const Eigen::RowVectorXd variance = (weight.transpose() * table.cwiseAbs2()) / (rows - 1.0);
  for (Eigen::Index k = 0; k < table.cols(); ++k) {
    if (variance[k] > 0.0) table.col(k) /= std::sqrt(variance[k]);
  }
}

Experiment clip(const FrameMatrix& signals, Eigen::Index begin, Eigen::Index end, Eigen::Index inputs) {
  return {signals.block(begin, 0, end - begin, inputs),
          signals.block(begin, inputs, end - begin, signals.cols() - inputs)};
}

Task halves(const std::string& name, FrameMatrix table, Eigen::Index inputs) {
  const Eigen::Index half = table.rows() / 2;
  standardize(table,
              Eigen::Array<Eigen::Index, Eigen::Dynamic, 1>::LinSpaced(table.rows(), 0, table.rows() - 1) < half);
  return {name, {clip(table, 0, half, inputs)}, {clip(table, half, table.rows(), inputs)}};
}

Task mocap_task(const std::filesystem::path& path) {
  const FrameMatrix table = read_table(path);
  FrameMatrix signals = table.rightCols(table.cols() - 2);
  standardize(signals, table.col(1).array() == 1.0);
  Task task{path.stem().string(), {}, {}};
  for (Eigen::Index begin = 0; begin < table.rows();) {
    Eigen::Index end = begin + 1;
    while (end < table.rows() && table(end, 0) == table(begin, 0)) ++end;
    (table(begin, 1) == 1.0 ? task.train : task.test).push_back(clip(signals, begin, end, signals.cols() / 2));
    begin = end;
  }
  return task;
}

CombineOptions parse_options(int argc, char** argv, CombineOptions combine) {
  IdentifyOptions& options = combine.identification;
  for (int k = 2; k < argc; ++k) {
    const std::string argument = argv[k];
    const std::string name = argument.substr(0, argument.find('='));
    const std::string value = argument.substr(std::min(argument.size(), name.size() + 1));
    if (name == "max_order")
      options.max_order = std::stoi(value);
    else if (name == "block_rows")
      options.block_rows = std::stoi(value);
    else if (name == "max_radius")
      options.max_radius = std::stod(value);
    else if (name == "tolerance")
      options.order_tolerance = std::stod(value);
    else if (name == "starts" && value == "lead_in")
      options.starts = strut::sysid::Starts::kLeadIn;
    else if (name == "max_states")
      combine.max_states = std::stoi(value);
    else if (name == "refine")
      options.refine_iterations = std::stoi(value);
    else if (name == "weighting" && value == "cva")
      options.weighting = Weighting::kCva;
    else if (name == "weighting" && value == "moesp")
      options.weighting = Weighting::kMoesp;
    else if (name == "weighting" && value == "n4sid")
      options.weighting = Weighting::kN4sid;
    else
      throw std::runtime_error("not an option: " + argument);
  }
  return combine;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, value < -999.0 ? "diverges" : "%.1f", value);
  return text;
}

double median(std::vector<double> numbers) {
  std::sort(numbers.begin(), numbers.end());
  return 0.5 * (numbers[(numbers.size() - 1) / 2] + numbers[numbers.size() / 2]);
}

/// Fits of one way over all sets.
struct Column {
  std::vector<double> fits;

  std::string add(double fit, int states) {
    fits.push_back(fit);
    return number(fit) + " (" + std::to_string(states) + ")";
  }
  [[nodiscard]] std::string summary() const {
    double total = 0.0;
    for (const double fit : fits) total += fit;
    return number(total / static_cast<double>(fits.size())) + " / " + number(median(fits));
  }
};

void print_rows(const std::vector<Task>& tasks, const std::map<std::string, Reference>& references,
                const CombineOptions& options) {
  std::puts(
      "| set | static map | SLICOT, best automatic | SLICOT, best of all | subspace | refined | combined | left-out |");
  std::puts("| --- | --- | --- | --- | --- | --- | --- | --- |");
  IdentifyOptions plain_options = options.identification;
  plain_options.refine_iterations = 0;
  Column fixed, automatic, best, plain, refined, combined;
  for (const Task& task : tasks) {
    std::vector<int> groups;
    for (std::size_t k = 0; k < task.train.size(); ++k) groups.push_back(static_cast<int>(k));
    const auto found = strut::sysid::identify(task.train, groups, plain_options);
    const auto mean = strut::sysid::identify_combined(task.train, groups, options);
    const auto known = references.find(task.name);
    const Reference reference = known == references.end() ? Reference() : known->second;
    fixed.fits.push_back(reference.static_map);
    automatic.fits.push_back(reference.automatic);
    best.fits.push_back(reference.best);
    const std::string plain_cell = plain.add(simulated_fit(found.system, task.test), found.system.num_states());
    const auto& subspace = mean.subspace.system;
    const std::string refined_cell = refined.add(simulated_fit(subspace, task.test), subspace.num_states());
    const std::string combined_cell = combined.add(simulated_fit(mean.system, task.test), mean.system.num_states());
    std::printf("| %s | %s | %s | %s | %s | %s | **%s** | %s |\n", task.name.c_str(),
                number(reference.static_map).c_str(), number(reference.automatic).c_str(),
                number(reference.best).c_str(), plain_cell.c_str(), refined_cell.c_str(), combined_cell.c_str(),
                number(mean.fit).c_str());
    std::fflush(stdout);
  }
  std::printf("| mean / median | %s | %s | %s | %s | %s | **%s** | |\n\n", fixed.summary().c_str(),
              automatic.summary().c_str(), best.summary().c_str(), plain.summary().c_str(), refined.summary().c_str(),
              combined.summary().c_str());
}

int run(int argc, char** argv) {
  const std::filesystem::path folder = argv[1];
  std::vector<Task> tasks;
  for (auto& row : read_csv(folder / "index.csv")) {
    tasks.push_back(halves(row["name"], read_table(folder / (row["name"] + ".dat")), std::stoi(row["nu"])));
  }
  CombineOptions options;
  options.identification.max_order = 8;
  options.identification.max_radius = 0.999;
  print_rows(tasks, read_reference(folder / "slicot_reference.csv", "dataset"), parse_options(argc, argv, options));
  tasks.clear();
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "mocap")) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  for (const auto& path : paths) tasks.push_back(mocap_task(path));
  print_rows(tasks, read_reference(folder / "slicot_reference_mocap.csv", "set"), parse_options(argc, argv, {}));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fputs("usage: sysid_study FOLDER [name=value ...]\n", stderr);
    return 2;
  }
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}
