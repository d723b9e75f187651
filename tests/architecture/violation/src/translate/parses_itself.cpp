// SPDX-License-Identifier: MIT
#include <flatbuffers/flatbuffers.h>
