// SPDX-License-Identifier: MIT
// What the server answers, one file of routes per part of the page.
#pragma once

#include "view/page_server.h"
#include "view/workspace.h"

namespace strut::cli {

/// The session, its clips, their curves and alignments.
void add_clip_routes(PageServer& server, Workspace& workspace);
void add_translate_routes(PageServer& server, Workspace& workspace);
void add_pair_routes(PageServer& server, Workspace& workspace);
void add_label_routes(PageServer& server, Workspace& workspace);

}  // namespace strut::cli
