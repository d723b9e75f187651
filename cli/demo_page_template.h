// SPDX-License-Identifier: MIT
// The demo's page without its data: cli/demo_page.html, which the build puts into the program.
#pragma once

namespace strut::cli {

/// HTML in which @DATA@ stands for the JSON of what is shown.
extern const char kDemoPageTemplate[];

}  // namespace strut::cli
