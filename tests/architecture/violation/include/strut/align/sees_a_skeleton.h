// SPDX-License-Identifier: MIT
// Alignment sees signals only.
#pragma once

#include <strut/motion/skeleton.h>
