// SPDX-License-Identifier: MIT
// The container in which numbers go to the page: how long the header is (4 bytes, little-endian), the header (JSON,
// padded with blanks to a multiple of four bytes), then the arrays that its "arrays" names, each at its byte from the
// end of the header. Read by viewer/src/data/container.ts; described in docs/viewer.md.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace strut::cli {

/// Numbers as a container holds them.
std::vector<float> as_floats(const Eigen::VectorXd& values);

class Container {
 public:
  using Json = nlohmann::ordered_json;
  explicit Container(Json header) : header_(std::move(header)) { header_["arrays"] = Json::array(); }

  /// Adds an array of 32-bit numbers; NaN stands for "no number".
  void add(std::string_view name, const std::vector<float>& values);
  /// The same in 16 bits a number, off by no more than rounding_error(values).
  void add_rounded(std::string_view name, const std::vector<float>& values);
  /// Half of 1/65534 of the range of `values`.
  static double rounding_error(const std::vector<float>& values);

  [[nodiscard]] Json& header() noexcept { return header_; }
  [[nodiscard]] const Json& header() const noexcept { return header_; }
  [[nodiscard]] std::string bytes() const;

 private:
  Json header_;
  std::string arrays_;
};

}  // namespace strut::cli
