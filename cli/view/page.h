// SPDX-License-Identifier: MIT
// The viewer's page as it is served and as reports are made of it: one HTML file that loads nothing else.
#pragma once

#include <string_view>

namespace strut::cli {

extern const std::string_view kViewerPage;

}  // namespace strut::cli
