// SPDX-License-Identifier: MIT
// Everything a library must not do, for the test that looks for it.
#include <cstdio>
#include <cstdlib>
#include <iostream>

void talks(int how) {
  if (how == 0) std::puts("printed");
  if (how == 1) std::cout << "streamed";
  if (how == 2) std::abort();
  std::exit(how);
}
