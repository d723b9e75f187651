// SPDX-License-Identifier: MIT
// A library's header must not reach the users of strut's.
#pragma once

#include <flatbuffers/flatbuffers.h>
