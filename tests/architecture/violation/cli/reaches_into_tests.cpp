// SPDX-License-Identifier: MIT
#include "support/data.h"
