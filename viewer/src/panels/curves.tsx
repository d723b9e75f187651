// SPDX-License-Identifier: MIT
export function Curves() {
  return null;
}
