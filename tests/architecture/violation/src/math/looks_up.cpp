// SPDX-License-Identifier: MIT
#include "math/missing.h"
#include "motion/posture.h"

#include <cmath>
